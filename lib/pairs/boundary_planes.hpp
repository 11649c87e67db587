/// \file
/// Boundary planes for cells around which the domain is convex: they replace its regions. Internal.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/domain/region_mesh.hpp"
#include "lib/neighbors/cell_bounds.hpp"
#include "lib/pairs/cell_hull.hpp"
#include "lib/regions/region_blocks.hpp"

namespace powercell::pairs {

/// The triangles of a boundary, and which of them are exactly coplanar.
class BoundaryPlanes {
 public:
  /// Keeps references. \pre `boundary` is boundary_of() a mesh of tetrahedra
  BoundaryPlanes(const RegionMesh& boundary, const RegionGroups& groups);

  std::size_t facets() const { return plane_.size(); }

 private:
  friend class PlaneSearch;
  const RegionMesh& mesh_;
  const RegionGroups& groups_;
  RegionBlocks blocks_;
  std::vector<std::uint32_t> vertex_;  // per vertex of the mesh: the first one at its position
  std::vector<std::uint32_t> plane_;   // per facet: the first facet in its plane
};

/// The search of one thread, with its scratch memory.
class PlaneSearch {
 public:
  explicit PlaneSearch(const BoundaryPlanes& boundary) : boundary_(boundary) {}

  enum class Found {
    nothing,  ///< the cell does not meet the boundary
    planes,   ///< within the cell, the domain is the intersection of their half-spaces (12d)
    unclear   ///< neither could be proved
  };
  /// Appends the planes that cut a cell, if it finds them.
  /// \param seed  of the cell
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
  std::vector<std::uint32_t> plane_;     // their planes
  std::vector<std::uint32_t> in_plane_;  // vertices of near facets in one plane, ascending
};

}  // namespace powercell::pairs
