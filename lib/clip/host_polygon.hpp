/// \file
/// A convex polygon in the plane, or in a triangle of a surface, as the host clips it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "lib/base/convex_ring.hpp"
#include "lib/clip/host_plane.hpp"
#include "lib/clip/pieces.hpp"

namespace powercell {

/// Its faces are its edges: edge f goes from vertex f to the next one.
class HostPolygon {
 public:
  static constexpr int dimension = 2;

  /// Edge k has the border ~k.
  void start(const HostRegion& region);
  /// Keeps the vertices whose side is below 0. \return whether the part cut off is connected
  bool cut(const std::vector<double>& side, const HostFace& line, const HostPlacer& place);
  /// Computes all vertices anew. To be called before the functions below.
  void finish(const HostPlacer& place);
  /// Measure, first moments and second moment (docs/mathematics.md (13)).
  std::array<double, 5> moments();

  std::size_t size() const { return ring_.size(); }
  const HostPoint& vertex(std::size_t v) const { return ring_[v].at; }
  ExactVertex borders(std::size_t v) const { return {border(before(v)), border(v), 0}; }
  std::size_t faces() const { return ring_.size(); }
  std::int32_t border(std::size_t f) const { return ring_[f].edge.border; }
  double measure(std::size_t f) const { return norm(ring_[after(f)].at.at - ring_[f].at.at); }
  bool is_on(std::size_t v, std::size_t f) const { return v == f || v == after(f); }
  std::size_t after(std::size_t v) const { return v + 1 == ring_.size() ? 0 : v + 1; }
  std::size_t before(std::size_t v) const { return v == 0 ? ring_.size() - 1 : v - 1; }
  /// Calls use(v, u, border) for the edges from v to u until it returns false. \return whether it never did
  template <class Use>
  bool all_edges(std::size_t, const Use& use) const {
    for (std::size_t v = 0; v < size(); ++v)
      if (!use(v, after(v), border(v))) return false;
    return true;
  }
  const std::vector<HostPlane>& facets() const { return facets_; }  ///< of the region
  void write_vertices(PieceBatch& row, std::size_t coordinates) const;

 private:
  ConvexRing<HostPoint, HostFace> ring_, other_;
  HostPlane ground_;
  std::vector<HostPlane> facets_;
};

}  // namespace powercell
