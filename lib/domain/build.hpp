/// \file
/// The constructors of region meshes behind Domain's, one file each.
#pragma once

#include <memory>
#include <span>

#include "lib/domain/region_mesh.hpp"

namespace powercell {

using RegionMeshPtr = std::shared_ptr<const RegionMesh>;

/// Each as the function of Domain with the same name.
RegionMeshPtr build_box(std::span<const double> low, std::span<const double> high);
RegionMeshPtr build_polygon(std::span<const PolygonPart> parts);
RegionMeshPtr build_surface(std::span<const double> vertices, std::span<const std::uint32_t> triangles);
RegionMeshPtr build_volume(std::span<const double> vertices, std::span<const std::uint32_t> tetrahedra);

}  // namespace powercell
