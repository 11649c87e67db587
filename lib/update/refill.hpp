/// \file
/// Triangulates the surroundings of some sites anew. Internal.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/update/flips.hpp"

namespace powercell {

/// Replaces all simplices at the sites by those of a small regular triangulation of all their corners. A
/// simplex of the whole triangulation is also one of any part of the sites with its corners, so where the
/// mesh is right around the hole its facets are found there. Where it is not, the hole grows by the sites of
/// the facets that are missing. Facets around the holes are left to the flipper. \param sites  distinct
/// \return the number of sites, those that holes grew by included
/// \throw MeshUnusable in a tie, or if holes grow too large
template <int D>
std::size_t refill_around(DualMesh<D>& mesh, Flipper<D>& flipper, std::vector<std::uint32_t> sites);

}  // namespace powercell
