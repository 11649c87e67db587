/// \file
/// What cells that lie wholly inside the domain need: its boundary, and one region around all of it.
/// Internal.
#pragma once

#include "lib/domain/region_mesh.hpp"

namespace powercell {

/// The boundary facets as regions of one dimension less: edges or triangles, with what pair enumeration reads
/// (corners and dimensions). Empty for surfaces.
RegionMesh boundary_of(const RegionMesh& mesh);

/// Whether the domain is a part of the space with more than one region, so that a cell can be wholly inside.
bool has_inside(const RegionMesh& mesh);

/// The mesh with one region more behind the others, of the same shape, that holds the whole domain; its
/// facets bound nothing of the domain. \pre has_inside(mesh)
RegionMesh with_container(const RegionMesh& mesh);

}  // namespace powercell
