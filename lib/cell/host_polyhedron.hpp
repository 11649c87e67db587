/// \file
/// A convex polyhedron as the host clips it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "lib/cell/host_plane.hpp"
#include "lib/cell/pieces.hpp"

namespace powercell {

/// A graph with three edges at each vertex, as in kernels/cell/polyhedron.cl: seen from outside, the
/// neighbours next[0..2] of a vertex go counter-clockwise, and face[k] lies between next[k] and next[k+1].
class HostPolyhedron {
 public:
  static constexpr int dimension = 3;

  /// The region's shape; facet f has the border ~f.
  void start(const HostRegion& region);
  /// Cuts off the vertices `outside`, in ascending order and not all there are, by a plane.
  /// \return whether they are connected
  bool cut(std::span<const std::uint32_t> outside, const HostFace& face, const HostPlacer& place);
  /// The vertices that the last cut made, or gave another number.
  const std::vector<std::uint32_t>& changed() const { return changed_; }
  /// Calls use(u) for the vertices next to v.
  template <class Use>
  void for_neighbors(std::size_t v, const Use& use) const {
    for (const std::uint32_t u : links_[v].next) use(u);
  }
  /// Places vertex v exactly.
  void sharpen(std::size_t v, const HostPlacer& place) { points_[v] = place.exactly(borders(v)); }
  /// Makes the order of faces and vertices that of the borders of the faces, whatever the cuts were.
  /// \param before  before(a, b): whether border a comes before b
  template <class Before>
  void sort_faces(const Before& before) {
    number_faces();
    std::vector<std::uint32_t> order(faces_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t f, std::uint32_t g) { return before(border(f), border(g)); });
    reorder(order);
  }
  /// Computes all vertices anew. To be called before the functions below.
  void finish(const HostPlacer& place);
  /// Measure, first moments and second moment (docs/mathematics.md (14), (14a)). To be called before
  /// `measure`.
  std::array<double, 5> moments();

  std::size_t size() const { return points_.size(); }
  const HostPoint& vertex(std::size_t v) const { return points_[v]; }
  void set_verified(std::size_t v) { points_[v].is_verified = true; }
  ExactVertex borders(std::size_t v) const {
    const Links& face = links_[v].face;
    return {border(face[0]), border(face[1]), border(face[2])};
  }
  std::size_t faces() const { return faces_.size(); }
  std::int32_t border(std::size_t f) const { return faces_[f].border; }
  double measure(std::size_t f) const { return area_[f]; }
  bool is_on(std::size_t v, std::size_t f) const {
    return links_[v].face[0] == f || links_[v].face[1] == f || links_[v].face[2] == f;
  }
  /// Calls use(v, u, border) for the edges of face f from v to u, each in the plane of `border`, until it
  /// returns false.
  /// \return whether it never did
  template <class Use>
  bool all_edges(std::size_t f, const Use& use) const {
    std::size_t v = mark_[f];
    do {
      const std::size_t k = slot_of(links_[v].face, f), u = links_[v].next[k];
      if (!use(v, u, border(links_[v].face[(k + 2) % 3]))) return false;
      v = u;
    } while (v != mark_[f]);
    return true;
  }
  const std::vector<HostPlane>& facets() const { return facets_; }  ///< of the region
  void write_vertices(PieceBatch& row, std::size_t coordinates) const;

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  using Links = std::array<std::uint32_t, 3>;
  struct Vertex {
    Links next, face;
  };
  /// An edge that a cut crosses, from a vertex that it keeps.
  struct Crossing {
    std::uint32_t kept, slot;   ///< the vertex and the edge there
    std::uint32_t right, left;  ///< the faces beside it, seen from outside towards `kept`
  };
  static std::uint32_t slot_of(const Links& links, std::size_t what) {
    return links[0] == what ? 0 : links[1] == what ? 1 : 2;
  }
  HostPoint place_vertex(const HostPlacer& place, const Links& face) const;
  void find_crossings(std::span<const std::uint32_t> outside);
  bool link_loop(std::uint32_t first);
  void remove(std::uint32_t v);
  void number_faces();
  void reorder(const std::vector<std::uint32_t>& order);

  std::vector<HostPoint> points_;
  std::vector<Vertex> links_;  ///< per vertex
  std::vector<HostFace> faces_;
  std::vector<std::uint32_t> mark_;       ///< per face: a vertex
  std::vector<std::uint32_t> slots_;      ///< for new vertices
  std::vector<std::uint8_t> is_outside_;  ///< during a cut, per vertex
  std::vector<std::uint32_t> changed_;
  std::vector<Crossing> crossings_;
  std::vector<double> area_;
  std::vector<HostPlane> facets_;
};

}  // namespace powercell
