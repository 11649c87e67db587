/// \file
/// The centre of each simplex: the vertex of the diagram where the cells of its corners meet. Internal.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/update/mesh.hpp"

namespace powercell {

/// The point of equal power distance from the corners: `at` and, from there, `rest`, so that places relative
/// to a corner are as exact as those computed relative to it.
struct Center {
  std::array<double, 3> at;
  std::array<float, 3> rest;
  float error;  ///< at least the distance from the true point; infinite if rounding leaves nothing
};

template <int D>
Center center_of(const DualMesh<D>& mesh, std::uint32_t s);

/// What new places or weights break.
struct Broken {
  std::vector<std::uint32_t> facets;    ///< across which a corner is in conflict
  std::vector<std::uint32_t> inverted;  ///< simplices that are not positive any more
};

/// Computes the centres of all simplices, and finds what is broken, ascending.
/// \param moved  whether sites may have new places; else all simplices are positive
/// \throw MeshUnusable in a tie
template <int D>
Broken find_broken(const DualMesh<D>& mesh, bool moved, int threads, std::vector<Center>& centers);

}  // namespace powercell
