/// \file
/// Meshes for cells that lie entirely inside the domain: its boundary, and one region that contains it.
/// Internal.
#pragma once

#include "lib/domain/region_mesh.hpp"

namespace powercell {

/// The boundary facets as regions of one dimension less, edges or triangles. Has only what the enumeration of
/// pairs reads: corners and dimensions. Empty for surfaces.
RegionMesh boundary_of(const RegionMesh& mesh);

/// Whether a cell can lie inside the domain and meet several of its regions. (A box is one region.)
bool has_inside(const RegionMesh& mesh);

/// The mesh with one more region at the end, of the same shape, that contains the domain; its facets lie
/// outside. \pre has_inside(mesh)
RegionMesh with_container(const RegionMesh& mesh);

}  // namespace powercell
