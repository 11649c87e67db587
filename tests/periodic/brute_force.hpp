/// \file
/// Periodic power diagrams by definition: each seed's cell is cut, in long double, by the bisectors with
/// every image of every seed up to a number of periods in each direction.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <powercell/diagram.hpp>
#include <vector>

#include "tests/support/generators.hpp"
#include "tests/support/polytope.hpp"

namespace powercell::test {

/// A periodic domain as the tests know it. Along an axis of a box that is not periodic the vector is 0 and
/// the box is bounded by `box`.
struct PeriodicSpace {
  int dimension = 2;
  std::array<std::array<double, 3>, 3> vector{};
  Box box;                    ///< bounded axes only
  std::array<int, 3> most{};  ///< images to try, in periods each way

  Domain domain() const;
  Real measure() const;
};

/// A box with edges along the axes from `low`, periodic where `periodic` is true.
PeriodicSpace periodic_box_space(int dimension, const Box& box, std::array<bool, 3> periodic, int most);
PeriodicSpace lattice_space(std::array<std::array<double, 3>, 3> vectors, int dimension, int most);

using ImageShift = std::array<std::int32_t, 3>;
struct PeriodicCell {
  Moments moments;  ///< about the seed
  /// Wall by neighbour and shift, the latter between the positions given.
  std::map<std::pair<std::uint32_t, ImageShift>, Real> wall;
};
std::vector<PeriodicCell> periodic_cells(const PeriodicSpace& space, const SeedArray& seeds);

/// Seeds at random in the space, each moved by up to `outside` periods in each direction.
SeedArray periodic_seeds(const PeriodicSpace& space, std::size_t n, Random& random);

/// Checks measures, centroids, walls with images, and cells of a diagram.
/// \param tolerance  of masses, relative to the mean; walls accordingly
void check_periodic(Diagram& diagram, const PeriodicSpace& space, const SeedArray& seeds,
                    const std::vector<PeriodicCell>& expected, double tolerance);

}  // namespace powercell::test
