/// \file
/// The figures of the paper that a program can redo. Each writes one CSV file; README.md says what it
/// tests, and plot.py draws it.
#pragma once

#include <cmath>

#include "bench/paper/table_file.hpp"
#include "bench/paper/trial.hpp"
#include "tests/support/domains.hpp"

namespace powercell::paper {

void lift_figure(const Study& study);     ///< 3: the height of the lift
void length_figure(const Study& study);   ///< 4: neighbours asked for at first
void twins_figure(const Study& study);    ///< 6: queries with the twin and without
void sets_figure(const Study& study);     ///< 8: uniformity of the locations, range of the weights
void surface_figure(const Study& study);  ///< 9: number of seeds on a surface
void volume_figure(const Study& study);   ///< 10: number of seeds in a volume

/// A domain with the name it has in the data.
struct Subject {
  std::string name;
  Domain domain;
  std::size_t n;  ///< how many seeds
};

/// n seeds uniform in measure on the domain, weights uniform in [0, range h^2] with the spacing
/// h = (measure / n)^(1/d), d the dimension of the cells.
inline test::SeedArray white_seeds(const Domain& domain, std::size_t n, double range) {
  test::Random random(1);
  test::SeedArray seeds{domain.dimension(), test::points_in(domain, n, random), std::vector<double>(n)};
  const double h = test::spacing(domain.measure(), n, domain.cell_dimension());
  for (double& w : seeds.weights) w = range * h * h * random.uniform();
  return seeds;
}

/// Microseconds a seed.
inline double per_seed(double seconds, std::size_t n) {
  return 1e6 * seconds / static_cast<double>(n);
}
/// The mean over n of a count.
inline double mean(std::uint64_t count, std::uint64_t n) {
  return static_cast<double>(count) / static_cast<double>(n);
}

}  // namespace powercell::paper
