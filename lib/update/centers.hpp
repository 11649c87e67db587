/// \file
/// The centre of each simplex: the vertex of the diagram where the cells of its corners meet. Internal.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/update/mesh.hpp"

namespace powercell {

/// The point of equal power distance from the corners, relative to the first corner.
struct Center {
  std::array<double, 3> at;
  double error;  ///< at least the distance from the true point; infinite if rounding leaves nothing
};

/// \return the centre, and the simplex's orientation if it is certain, else 0
template <int D>
std::pair<Center, int> center_of(const DualMesh<D>& mesh, std::uint32_t s);

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
