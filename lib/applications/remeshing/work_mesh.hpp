/// \file
/// The new mesh while it is edited: vertices on the surface; flips, collapses and splits of edges.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "lib/applications/remeshing/dual.hpp"
#include "lib/applications/remeshing/sampling.hpp"

namespace powercell::remeshing {

/// An oriented manifold. All operations keep it one.
class WorkMesh {
 public:
  using Corners = std::array<std::uint32_t, 3>;

  WorkMesh(const Sampling& sampling, const DualMesh& dual);
  /// The triangles of the surface themselves, to be collapsed.
  WorkMesh(const Surface& surface, const Sizing& sizing, const std::vector<Curve>& curves);

  struct Vertex {
    Place place;
    double h = 0;  ///< target edge length
    Hold::Kind kind = Hold::Kind::free;
    bool boundary = false;
  };
  std::size_t vertex_count() const { return vertex_.size(); }
  std::size_t alive() const { return alive_; }
  bool is_alive(std::uint32_t v) const { return !around_[v].empty(); }
  const Vertex& vertex(std::uint32_t v) const { return vertex_[v]; }
  Vec at(std::uint32_t v) const { return vertex_[v].place.at; }
  void move(std::uint32_t v, const Place& place, double h);
  const std::vector<Corners>& triangles() const { return triangle_; }  ///< removed ones are {0, 0, 0}
  const std::vector<std::uint32_t>& around(std::uint32_t v) const { return around_[v]; }  ///< triangles
  const Corners& triangle(std::uint32_t t) const { return triangle_[t]; }
  std::size_t degree(std::uint32_t v) const { return around_[v].size() + (vertex_[v].boundary ? 1 : 0); }
  bool kept(std::uint32_t a, std::uint32_t b) const;  ///< whether the edge is part of a kept curve
  /// Vertices that share an edge with v, ascending.
  std::vector<std::uint32_t> neighbors(std::uint32_t v) const;

  /// An inner edge with its two triangles: left (a, b, c) and right (b, a, d).
  struct Edge {
    std::uint32_t a, b, c, d, left, right;
  };
  /// The inner edge from a to b, if there is one.
  std::optional<Edge> edge(std::uint32_t a, std::uint32_t b) const;

  /// Whether edge c-d may replace a-b: a-b is not kept, c-d does not exist, and no degree falls below 3.
  bool can_flip(const Edge& edge) const;
  void flip(const Edge& edge);
  /// Whether a can be collapsed into its neighbour b: the mesh stays a manifold (link condition), a is free
  /// or on the same curve, and b is left with `least_degree` at least.
  bool can_collapse(std::uint32_t a, std::uint32_t b, std::size_t least_degree) const;
  void collapse(std::uint32_t a, std::uint32_t b);
  /// Adds a free vertex on an inner edge that is not kept.
  /// \return its index
  std::uint32_t split(const Edge& edge, const Place& place, double h);

 private:
  void detach(std::uint32_t v, std::uint32_t t);
  void link(std::uint32_t a, std::uint32_t b);
  std::vector<std::uint32_t> triangles_at(std::uint32_t a, std::uint32_t b) const;
  bool adjacent(std::uint32_t a, std::uint32_t b) const;

  std::vector<Vertex> vertex_;
  std::vector<std::vector<std::uint32_t>> chord_, around_;
  std::vector<Corners> triangle_;
  std::size_t alive_ = 0;
};

/// The point of the surface nearest to x, among the triangles connected to `from` within the distance |x -
/// from|.
Place project(const Surface& surface, const Place& from, Vec x);

}  // namespace powercell::remeshing
