/// \file
/// Transport problems for the tests: with a known solution, and on every kind of domain.
#pragma once

#include <powercell/shapes.hpp>
#include <powercell/transport.hpp>
#include <string>
#include <vector>

#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

namespace powercell::test {

/// Seeds z = s y + t for the centres y of a k^d grid on the unit cube about the origin, with equal masses.
/// The cells of the solution are those of the grid.
struct MovedGrid {
  MovedGrid(int per_axis, int dimension, double scale, double shift);

  Domain domain;
  std::vector<double> positions, weights;  ///< weights: |z|² - s |y|² up to a constant, with mean 0
  double cost;                             ///< W2²
};

struct TransportCase {
  std::string name;
  Domain domain;
  SeedArray seeds;
  std::vector<double> masses;  ///< with the sum of the domain's mass
};

/// Boxes, polygons, volumes and surfaces with n seeds in or near them, and masses over a factor `range`.
std::vector<TransportCase> transport_cases(std::size_t n, double range);
/// n masses with the sum `total`, whose logarithms are uniform over a factor `range`.
std::vector<double> random_masses(std::size_t n, double range, double total, Random& random);

/// Options with a precision, for the first device of main_setups().
TransportOptions transport_options(Precision precision = Precision::float64);
const Device& transport_device();

/// max |a_i - b_i|
double distance(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace powercell::test
