/// \file
/// Transports to try: with a known solution, and on every kind of domain.
#pragma once

#include <powercell/shapes.hpp>
#include <powercell/transport.hpp>
#include <string>
#include <vector>

#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

namespace powercell::test {

/// Seeds z = s y + t for the centres y of a k^d grid on the unit cube about 0, with equal masses. The cells
/// of the solution are the grid's.
struct MovedGrid {
  MovedGrid(int per_axis, int dimension, double scale, double shift);

  Domain domain;
  std::vector<double> positions, weights;  ///< weights of mean 0: |z|² - s |y|² but for a constant
  double cost;                             ///< W2²
};

struct TransportCase {
  std::string name;
  Domain domain;
  SeedArray seeds;
  std::vector<double> masses;  ///< sum to the domain's
};

/// Polygons, surfaces, volumes and boxes with n seeds in or near them; masses over a factor `range`.
std::vector<TransportCase> transport_cases(std::size_t n, double range);
/// n masses that sum to `total`, spread evenly in the logarithm over a factor `range`.
std::vector<double> random_masses(std::size_t n, double range, double total, Random& random);

/// The device of main_setups() in a precision.
TransportOptions transport_options(Precision precision = Precision::float64);
const Device& transport_device();

/// max |a_i - b_i|
double distance(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace powercell::test
