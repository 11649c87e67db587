/// \file
/// A convex polygon in the plane, or in a triangle of a surface, as the host clips it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "lib/cell/host_plane.hpp"
#include "lib/cell/pieces.hpp"

namespace powercell {

/// A ring of vertices, linked both ways. Its faces are its edges: edge f goes from vertex f to the next one.
class HostPolygon {
 public:
  static constexpr int dimension = 2;

  /// Edge k has the border ~k.
  void start(const HostRegion& region);
  /// Cuts off the vertices `outside`, in ascending order and not all there are, by a line.
  /// Takes time by their number alone.
  /// \return whether they are connected
  bool cut(std::span<const std::uint32_t> outside, const HostFace& line, const HostPlacer& place);
  /// The vertices that the last cut made, or gave another number.
  const std::vector<std::uint32_t>& changed() const { return changed_; }
  /// Calls use(u) for the vertices next to v.
  template <class Use>
  void for_neighbors(std::size_t v, const Use& use) const {
    use(ring_[v].previous);
    use(ring_[v].next);
  }
  /// Places vertex v exactly.
  void sharpen(std::size_t v, const HostPlacer& place);
  /// Makes the order of vertices that of the borders of the faces, whatever the cuts were.
  /// \param before  before(a, b): whether border a comes before b
  template <class Before>
  void sort_faces(const Before& before) {
    for (std::uint32_t v = 0; v < ring_.size(); ++v)
      if (before(border(v), border(first_))) first_ = v;
  }
  /// Computes all vertices anew and puts them in order. To be called before the functions below.
  void finish(const HostPlacer& place);
  /// Measure, first moments and second moment (docs/mathematics.md (13)).
  std::array<double, 5> moments();

  std::size_t size() const { return ring_.size(); }
  const HostPoint& vertex(std::size_t v) const { return ring_[v].at; }
  void set_verified(std::size_t v) { ring_[v].at.is_verified = true; }
  ExactVertex borders(std::size_t v) const { return {border(before(v)), border(v), 0}; }
  std::size_t faces() const { return ring_.size(); }
  std::int32_t border(std::size_t f) const { return ring_[f].edge.border; }
  double measure(std::size_t f) const { return norm(ring_[after(f)].at.at - ring_[f].at.at); }
  bool is_on(std::size_t v, std::size_t f) const { return v == f || v == after(f); }
  std::size_t after(std::size_t v) const { return ring_[v].next; }
  std::size_t before(std::size_t v) const { return ring_[v].previous; }
  /// Calls use(v, u, border) for the edges from v to u until it returns false.
  /// \return whether it never did
  template <class Use>
  bool all_edges(std::size_t, const Use& use) const {
    for (std::size_t v = 0; v < size(); ++v)
      if (!use(v, after(v), border(v))) return false;
    return true;
  }
  const std::vector<HostPlane>& facets() const { return facets_; }  ///< of the region
  void write_vertices(PieceBatch& row, std::size_t coordinates) const;

 private:
  struct Corner {
    HostPoint at;
    HostFace edge;
    std::uint32_t next = 0, previous = 0;
    bool is_outside = false;  ///< during a cut
  };
  void link(std::uint32_t v, std::uint32_t next) {
    ring_[v].next = next;
    ring_[next].previous = v;
  }
  void remove(std::uint32_t v);
  void sort_ring();

  std::vector<Corner> ring_, sorted_;
  std::uint32_t first_ = 0;  ///< where the ring starts when it is sorted
  std::vector<std::uint32_t> changed_;
  HostPlane ground_;
  std::vector<HostPlane> facets_;
};

}  // namespace powercell
