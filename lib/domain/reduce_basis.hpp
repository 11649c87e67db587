/// \file
/// Reduction of lattice bases of two or three vectors.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace powercell {

/// A vector of a lattice with its coordinates in the basis that was given.
struct LatticeVector {
  std::array<long double, 3> x{};
  std::array<std::int64_t, 3> of_given{};
};

/// Selling's reduction: vectors of the same lattice that, with minus their sum, have no positive inner
/// product with each other. The walls of the lattice's Voronoi cell are then halfway to the sums of subsets
/// and to their negatives. Empty if a factor of a vector as given would exceed 2^20.
std::vector<LatticeVector> reduced_basis(std::vector<LatticeVector> basis);

/// The largest coordinate of the lattice's Voronoi cell along each vector of a reduced basis. The cell has
/// its centre at 0.
/// \param dual  per vector the linear function that is its coordinate
std::array<double, 3> extent_of_voronoi_cell(const std::vector<LatticeVector>& basis,
                                             const std::array<std::array<double, 3>, 3>& dual);

}  // namespace powercell
