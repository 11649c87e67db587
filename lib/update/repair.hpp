/// \file
/// Repairs a dual mesh whose sites have new places or weights. Internal.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/update/centers.hpp"

namespace powercell {

/// What a repair did.
struct RepairCounts {
  std::size_t flips = 0;
  std::size_t refilled = 0;  ///< sites whose surroundings were triangulated anew
  std::size_t inserted = 0;  ///< hidden sites that have a cell now
};

/// Makes the mesh the regular triangulation of its sites as they are now: where it is broken simplices are
/// flipped; where no flip helps the simplices about the sites concerned are replaced by those of a small mesh
/// of these sites; and hidden sites are inserted that are not hidden any more.
/// \param broken   by find_broken()
/// \param moved    as there
/// \param centers  of the simplices, kept up to date
/// \throw MeshUnusable in a tie, or if too much is broken; the mesh is then of no use any more
template <int D>
RepairCounts repair(DualMesh<D>& mesh, const Broken& broken, bool moved, std::vector<Center>& centers);

}  // namespace powercell
