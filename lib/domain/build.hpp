/// \file
/// The constructors of region meshes, one file each.
#pragma once

#include <memory>
#include <span>

#include "lib/domain/region_mesh.hpp"

namespace powercell {

using RegionMeshPtr = std::shared_ptr<const RegionMesh>;

/// The mesh behind the function of Domain with the same name.
RegionMeshPtr build_box(std::span<const double> low, std::span<const double> high);
RegionMeshPtr build_periodic_box(std::span<const double> low, std::span<const double> high,
                                 std::span<const bool> periodic);
RegionMeshPtr build_lattice(std::span<const double> vectors, std::span<const double> origin);
RegionMeshPtr build_polygon(std::span<const PolygonPart> parts);
RegionMeshPtr build_surface(std::span<const double> vertices, std::span<const std::uint32_t> triangles);
RegionMeshPtr build_solid(std::span<const double> vertices, std::span<const std::uint32_t> triangles);
RegionMeshPtr build_volume(std::span<const double> vertices, std::span<const std::uint32_t> tetrahedra);

using Repeated = std::vector<std::array<std::uint32_t, 2>>;  ///< see MeshReport::repeated

/// The mesh of a list of triangles (`corners` 3) or tetrahedra (4), without borders. Leaves out flat and
/// repeated simplices, reports them, and swaps the last two corners of negative ones.
/// \param signed_measure  the area or volume of the simplex with these corners, 0 if it is flat
/// \param repeated  as in MeshReport, ascending
/// \throw Error invalid_domain: wrong arrays, all simplices flat, coordinates or measure out of range
std::shared_ptr<RegionMesh> simplex_mesh(std::span<const double> vertices,
                                         std::span<const std::uint32_t> simplices, int corners,
                                         long double (*signed_measure)(const double* const* corner),
                                         Repeated repeated = {});

}  // namespace powercell
