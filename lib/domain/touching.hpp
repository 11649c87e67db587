/// \file
/// Rings and parts of a polygon that touch or overlap. Internal.
#pragma once

#include "lib/domain/geos.hpp"
#include "lib/domain/rings.hpp"

namespace powercell {

/// Makes every vertex that lies exactly on an edge of another ring a vertex of that ring too, so that
/// touching rings share whole edges.
void split_touched_edges(geos::Context& geos, IndexedRings& rings);

/// Checks that no two parts overlap; they may touch in points or along edges.
/// \param polygons one for each part, each valid
/// \throw Error invalid_domain: which two parts overlap, and where
void check_disjoint(geos::Context& geos, const std::vector<geos::Geometry>& polygons);

}  // namespace powercell
