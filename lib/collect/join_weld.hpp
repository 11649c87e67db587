/// \file
/// Finds which vertices of the pieces of one cell are the same point, and which interior facets between
/// the pieces are removed once the pieces are joined. Internal.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <powercell/domain.hpp>
#include <powercell/results.hpp>
#include <span>
#include <utility>
#include <vector>

#include "lib/domain/region_mesh.hpp"

namespace powercell {

/// Vertices are welded facet by facet: the facet of a piece in region r that names region s is the facet of
/// the piece in s that names r, corner by corner. So how far rounding has moved a corner matters only for
/// telling corners of one facet apart, which holds in double and in float, and no tolerance can tie together
/// what only lies close. In polygons, parts of a cell that touch in a vertex of the domain's boundary share
/// it, so that rings can be told apart there; elsewhere parts that share no facet share no vertex. Vertices
/// and faces are numbered from 0 within the cell.
class CellWeld {
 public:
  CellWeld(const Domain& domain, const Cells& cells);

  void weld(std::size_t cell);

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(parent_.size()); }
  /// The vertex that stands for v and all that are welded to it: the least of them.
  std::uint32_t same(std::uint32_t v) const { return parent_[v]; }
  const double* position(std::uint32_t v) const {
    return &cells_.vertices[(first_vertex_ + v) * static_cast<std::size_t>(cells_.dimension)];
  }
  /// Is v on an interior facet, so that only the cutting of the domain may have put it there?
  bool on_interior(std::uint32_t v) const { return on_interior_[parent_[v]] != 0; }

  std::size_t face_count() const { return face_.size() - 1; }
  /// An edge (two vertices) of a polygon or surface, or a face's loop, welded vertices not yet looked up.
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
  std::uint32_t root(std::uint32_t v);
  void unite(std::uint32_t a, std::uint32_t b);
  void unite(const Pairs& pairs);
  double distance2(std::uint32_t a, std::uint32_t b) const;
  double extent2(std::uint32_t face) const;
  double pair_corners(std::uint32_t a, std::uint32_t b, bool opposite, Pairs& pairs) const;
  double pair_nearest(std::uint32_t a, std::uint32_t b, Pairs& pairs) const;

  const Cells& cells_;
  const RegionMesh& mesh_;
  bool surface_;
  double diagonal_;  ///< diagonal of the domain
  double rounding_;  ///< what rounding to double moves a coordinate by
  std::size_t first_vertex_ = 0, first_face_ = 0;
  std::vector<std::uint32_t> parent_, corners_;
  std::vector<std::array<std::uint32_t, 2>> boundary_ends_;  ///< polygon: vertices of each boundary facet
  std::vector<std::size_t> face_, piece_;
  std::vector<std::uint8_t> on_interior_, removed_;
  std::vector<Facet> facets_;
  std::vector<double> mismatch2_;
};

}  // namespace powercell
