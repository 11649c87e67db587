/// \file
/// Rings and parts of a polygon that meet: what is legal, and shared vertices where they touch.
#pragma once

#include "lib/domain/geos.hpp"
#include "lib/domain/rings.hpp"

namespace powercell {

/// Makes every vertex that lies exactly on an edge of another ring a vertex of that ring too, so that
/// touching rings share whole edges.
void split_touched_edges(geos::Context& geos, IndexedRings& rings);

/// \param polygons one for each part, each valid on its own
/// \throw Error invalid_domain: two parts overlap (which, where). Touching in points or along edges is
/// legal.
void check_disjoint(geos::Context& geos, const std::vector<geos::Geometry>& polygons);

}  // namespace powercell
