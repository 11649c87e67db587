/// \file
/// Meshes for cells that lie entirely inside the domain: its boundary, and one region that contains it.
#pragma once

#include <span>

#include "lib/domain/region_mesh.hpp"

namespace powercell {

/// The boundary facets as regions of one dimension less, edges or triangles. Has only what the enumeration of
/// pairs reads: corners and dimensions. Empty for surfaces.
RegionMesh boundary_of(const RegionMesh& mesh);

/// The boundary facets of tetrahedra as triangles of a surface, outward, with the frame of `mesh`. Every edge
/// of a triangle counts as boundary, because only its shape matters.
/// \pre mesh is a solid, or consists of tetrahedra
RegionMesh boundary_surface(const RegionMesh& mesh);

/// Numbers of the edges of triangles, by facet slot: the same for all edges between the same two positions.
std::vector<std::uint32_t> edge_numbers(const RegionMesh& triangles);

/// Boxes as regions, with the frame of `mesh`, a volume. Their facets lie outside.
/// \param corners  per box: the low corner, then the high one
RegionMesh boxes_around(const RegionMesh& mesh, std::span<const double> corners);

/// Whether a cell can lie inside the domain and meet several of its regions. (A box is one region.)
bool has_inside(const RegionMesh& mesh);

/// The mesh with one more region at the end, of the same shape, that contains the domain; its facets lie
/// outside.
/// \pre has_inside(mesh)
RegionMesh with_container(const RegionMesh& mesh);

}  // namespace powercell
