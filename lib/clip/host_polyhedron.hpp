/// \file
/// A convex polyhedron as the host clips it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "lib/clip/host_plane.hpp"
#include "lib/clip/pieces.hpp"

namespace powercell {

/// A graph with three edges at each vertex, as in kernels/cell/polyhedron.cl: seen from outside, the
/// neighbours next[0..2] of a vertex go counter-clockwise, and face[k] lies between next[k] and next[k+1].
class HostPolyhedron {
 public:
  static constexpr int dimension = 3;

  /// The region's shape; facet f has the border ~f.
  void start(const HostRegion& region);
  /// Keeps the vertices whose side is below 0. \return whether the part cut off is connected
  bool cut(const std::vector<double>& side, const HostFace& face, const HostPlacer& place);
  /// Computes all vertices anew. To be called before the functions below.
  void finish(const HostPlacer& place);
  /// Measure, first moments and second moment (docs/mathematics.md (14), (14a)). To be called before
  /// `measure`.
  std::array<double, 5> moments();

  std::size_t size() const { return points_.size(); }
  const HostPoint& vertex(std::size_t v) const { return points_[v]; }
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
  /// returns false. \return whether it never did
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
  void find_crossings(const std::vector<double>& side);
  bool link_loop(std::uint32_t first);
  void remove(std::uint32_t v);
  void number_faces();

  std::vector<HostPoint> points_;
  std::vector<Vertex> links_;  ///< per vertex
  std::vector<HostFace> faces_;
  std::vector<std::uint32_t> mark_;  ///< per face: a vertex
  std::vector<std::uint32_t> outside_;
  std::vector<Crossing> crossings_;
  std::vector<double> area_;
  std::vector<HostPlane> facets_;
};

}  // namespace powercell
