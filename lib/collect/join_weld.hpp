/// \file
/// Finds which vertices of the pieces of one cell are the same point, and which facets between pieces
/// disappear when they are joined.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <powercell/domain.hpp>
#include <powercell/results.hpp>
#include <span>
#include <utility>
#include <vector>

#include "lib/base/disjoint_sets.hpp"
#include "lib/domain/region_mesh.hpp"

namespace powercell {

/// Welds vertices facet by facet: the facet to region s of a piece in region r is the facet to r of the piece
/// in s, and their corners correspond. So rounding must only be smaller than the distance between the corners
/// of one facet, in double and in float, and no tolerance can weld points that are merely close. In polygons,
/// parts of a cell that touch in a vertex of the domain's boundary share it, which separates rings there;
/// elsewhere parts without a common facet share no vertex. Vertices and faces are numbered from 0 within the
/// cell.
class CellWeld {
 public:
  CellWeld(const Domain& domain, const Cells& cells);

  void weld(std::size_t cell);

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(same_.size()); }
  /// The representative of v: the lowest vertex that is welded to it.
  std::uint32_t same(std::uint32_t v) const { return same_[v]; }
  const double* position(std::uint32_t v) const {
    return &cells_.vertices[(first_vertex_ + v) * static_cast<std::size_t>(cells_.dimension)];
  }
  /// Whether v lies on an interior facet, so that it may come from the cutting of the domain only.
  bool on_interior(std::uint32_t v) const { return on_interior_[same_[v]] != 0; }

  std::size_t face_count() const { return face_.size() - 1; }
  /// An edge (two vertices) of a polygon or surface, or the loop of a face, before welding: see same().
  std::span<const std::uint32_t> face(std::size_t f) const {
    return std::span(corners_).subspan(face_[f], face_[f + 1] - face_[f]);
  }
  const Border& border(std::size_t f) const { return cells_.border[first_face_ + f]; }
  bool removed(std::size_t f) const { return removed_[f] != 0; }
  std::size_t piece_count() const { return piece_.size() - 1; }
  /// The faces of piece p are [piece(p), piece(p + 1)).
  std::size_t piece(std::size_t p) const { return piece_[p]; }

 private:
  struct Facet {
    std::uint32_t region, behind, face;
  };
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  void gather(std::size_t cell);
  void match_facets();
  void match_surface_edge(std::uint32_t f, const Facet& facet);
  void seal(const std::vector<Facet>& open);
  void unite_at_boundary_vertices();
  void unite_short_edges();
  void unite(const Pairs& pairs);
  double distance2(std::uint32_t a, std::uint32_t b) const;
  double extent2(std::uint32_t face) const;
  double pair_corners(std::uint32_t a, std::uint32_t b, bool opposite, Pairs& pairs) const;
  double pair_nearest(std::uint32_t a, std::uint32_t b, Pairs& pairs) const;

  const Cells& cells_;
  const RegionMesh& mesh_;
  bool surface_;
  double diagonal_;  ///< of the domain
  double rounding_;  ///< bound for the rounding of a coordinate to double
  std::size_t first_vertex_ = 0, first_face_ = 0;
  DisjointSets welded_;
  std::vector<std::uint32_t> same_, corners_;
  std::vector<std::array<std::uint32_t, 2>> boundary_ends_;  ///< polygon: vertices of each boundary facet
  std::vector<std::size_t> face_, piece_;
  std::vector<std::uint8_t> on_interior_, removed_;
  std::vector<Facet> facets_;
  std::vector<double> mismatch2_;
};

}  // namespace powercell
