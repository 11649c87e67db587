/// \file
/// Cells that the domain is convex around: cut by planes of its boundary, not by its regions. Internal.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/domain/region_mesh.hpp"
#include "lib/neighbors/cell_bounds.hpp"
#include "lib/pairs/cell_hull.hpp"
#include "lib/regions/region_blocks.hpp"

namespace powercell::pairs {

/// The triangles of a boundary, and which of them lie in one plane exactly.
class BoundaryPlanes {
 public:
  /// Keeps references. \pre boundary is that of tetrahedra (boundary_of), seen from outside
  BoundaryPlanes(const RegionMesh& boundary, const RegionGroups& groups);

  std::size_t facets() const { return plane_.size(); }

 private:
  friend class PlaneSearch;
  const RegionMesh& mesh_;
  const RegionGroups& groups_;
  RegionBlocks blocks_;
  std::vector<std::uint32_t> vertex_;  // per vertex of the mesh: the first one at this place
  std::vector<std::uint32_t> plane_;   // per facet: the first facet of its plane
};

/// One worker's search with its scratch memory; not thread-safe.
class PlaneSearch {
 public:
  explicit PlaneSearch(const BoundaryPlanes& boundary) : boundary_(boundary) {}

  enum class Found {
    nothing,  ///< the cell does not meet the boundary
    planes,   ///< the domain is the intersection of the half-spaces as far as the cell reaches
    unclear   ///< neither, as far as can be told
  };
  /// Appends the planes if they are found. \param seed  of the cell
  Found find(const double* seed, const CellHull& cell, std::vector<LocalPlane>& planes);

 private:
  enum class Meeting { none, some, unclear };
  const double* corner(std::uint32_t facet, std::size_t k) const;
  std::uint32_t vertex(std::uint32_t facet, std::size_t k) const;
  bool gather(std::size_t level, std::size_t group, const double* seed, const CellHull& cell);
  Meeting meets_box(std::uint32_t facet, const double* seed, const CellHull& cell) const;
  bool convex_around();
  void gather_vertices(std::uint32_t plane);
  int side(std::uint32_t plane, std::uint32_t facet, std::size_t k) const;
  LocalPlane plane_of(std::uint32_t facet, const double* seed, double reach) const;

  const BoundaryPlanes& boundary_;
  std::vector<std::uint32_t> near_;      // facets that meet the box of the cell
  std::vector<std::uint32_t> plane_;     // planes of those
  std::vector<std::uint32_t> in_plane_;  // ascending: vertices of those in the plane that is looked at
};

}  // namespace powercell::pairs
