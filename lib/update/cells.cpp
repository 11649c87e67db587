#include "lib/update/cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kernels/layout.h"
#include "lib/base/vector_copies.hpp"
#include "lib/base/vectors.hpp"
#include "lib/domain/region_mesh.hpp"

namespace powercell {
namespace {

using Point = Vector3<double>;

constexpr double unit = std::numeric_limits<double>::epsilon();
/// Of the cell's radius, the largest error of a vertex that is used: in space, where it lies along the common
/// line of planes that are nearly dependent, measures hardly depend on it; in the plane the lengths of walls
/// do.
constexpr double most_error[] = {1e-11, 1e-9};
/// Cells smaller than this part of the cube (or square) of their radius are clipped exactly.
constexpr double plainly_solid = 1e-9;
/// A wall in the mesh is none without extent, whatever rounding leaves of it (as in HostWalls).
constexpr double next_to_nothing = 1e-59;

ConvexBounds::Plane plane_through(const Point& at, const Point& normal) {
  const double length = norm(normal);
  if (!(length > 0)) return {{}, 0};
  const Point n = 1 / length * normal;
  return {n, dot(n, at)};
}

/// The vertices of a cell relative to its site. \return the largest squared distance and error of one
POWERCELL_VECTOR_COPIES std::pair<double, double> place_vertices(const Center* centers,
                                                                 std::span<const std::uint32_t> simplices,
                                                                 const Site& here, Point* vertices) {
  double square = 0;
  float error = 0;
  for (std::size_t v = 0; v < simplices.size(); ++v) {
    const Center& center = centers[simplices[v]];
    Point at;
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = (center.at[k] - here[k]) + static_cast<double>(center.rest[k]);
    const double distance = dot(at, at);
    square = distance > square ? distance : square;
    error = center.error > error ? center.error : error;
    vertices[v] = at;
  }
  return {square, static_cast<double>(error)};
}

POWERCELL_VECTOR_COPIES void sum_loop(const Point* vertices, const std::uint8_t* loop, std::size_t count,
                                      const Point& normal, WallSums& sums) {
  const Point top = vertices[loop[0]];
  Point a = vertices[loop[1]] - top;
  double one = 0, square = 0, x = 0, y = 0, z = 0, aa = dot(a, a);
  for (std::size_t k = 2; k < count; ++k) {
    const Point b = vertices[loop[k]] - top;
    const double part = dot(cross(a, b), normal), bb = dot(b, b);
    one += part;
    square += part * (aa + bb + dot(a, b));
    x += part * (a[0] + b[0]);
    y += part * (a[1] + b[1]);
    z += part * (a[2] + b[2]);
    a = b;
    aa = bb;
  }
  // Moved from the top to the site.
  sums.one += one;
  const Point s{x, y, z};
  for (std::size_t k = 0; k < 3; ++k) sums.x[k] += s[k] + 3 * one * top[k];
  sums.square += 2 * square + 8 * dot(top, s) + 12 * one * dot(top, top);
}

}  // namespace

ConvexBounds::ConvexBounds(const HostScene& scene) {
  const RegionMesh& mesh = *scene.mesh;
  const auto corner = [&](std::size_t k) {
    const auto& c = scene.corners[mesh.region_vertex[k]];
    return Point{c[0], c[1], c[2]};
  };
  const std::size_t count = mesh.region_vertex.size();
  for (std::size_t k = 0; k < count; ++k)
    for (const double x : corner(k)) size = std::max(size, std::fabs(x));
  if (mesh.shape == RegionShape::polygon) {
    for (std::size_t k = 0; k < count; ++k) {
      const Point from = corner(k), along = corner((k + 1) % count) - from;
      planes.push_back(plane_through(from, {along[1], -along[0], 0}));
    }
  } else if (mesh.shape == RegionShape::box) {
    for (std::size_t k = 0; k < 3; ++k) {
      Point normal{};
      normal[k] = 1;
      planes.push_back({-1.0 * normal, -corner(0)[k]});
      planes.push_back({normal, corner(7)[k]});
    }
  } else {
    for (const auto& facet : tetrahedron_facet) {
      const Point a = corner(facet[0]);
      planes.push_back(plane_through(a, cross(corner(facet[1]) - a, corner(facet[2]) - a)));
    }
  }
}

template <int D>
void CellEvaluator<D>::find_vertices(const CellGraph& graph) {
  vertices_.resize(graph.vertices.size());
  const auto [square, error] = place_vertices(centers_.data(), graph.vertices, here_, vertices_.data());
  reach_ = std::sqrt(square) * (1 + 8 * unit);
  error_ = error;
}

/// On which side of a facet all vertices are, with the sides of each in outside_.
template <int D>
typename CellEvaluator<D>::Place CellEvaluator<D>::side_of(const ConvexBounds::Plane& plane, double room) {
  const double margin = error_ + 16 * unit * (reach_ + bounds_.size);
  std::size_t outside = 0;
  outside_.clear();
  for (const Point& v : vertices_) {
    const double beyond = dot(plane.normal, v) - room;
    if (!(std::fabs(beyond) > margin)) return Place::unclear;
    outside_.push_back(beyond > 0 ? 1 : 0);
    outside += outside_.back();
  }
  return outside == 0 ? Place::inside : outside == vertices_.size() ? Place::outside : Place::cut;
}

template <int D>
typename CellEvaluator<D>::Place CellEvaluator<D>::find_place() {
  const Point here{here_[0], here_[1], here_[2]};
  const double margin = error_ + 16 * unit * (reach_ + bounds_.size + norm(here));
  std::size_t cuts = 0;
  for (const ConvexBounds::Plane& plane : bounds_.planes) {
    const double room = plane.offset - dot(plane.normal, here);
    if (reach_ < room - margin) continue;
    std::vector<std::uint8_t> before = cuts > 0 ? outside_ : std::vector<std::uint8_t>();
    const Place place = side_of(plane, room);
    if (place == Place::outside || place == Place::unclear) return place;
    if (place == Place::inside) {
      outside_ = std::move(before);
      continue;
    }
    if (++cuts > 1) return Place::unclear;
    facet_ = plane;
    room_ = room;
  }
  return cuts == 0 ? Place::inside : Place::cut;
}

template <int D>
Point CellEvaluator<D>::normal_of(std::uint32_t neighbor) const {
  const Site& there = mesh_.sites()[neighbor];
  return {there[0] - here_[0], there[1] - here_[1], there[2] - here_[2]};
}

template <int D>
double CellEvaluator<D>::level_of(std::uint32_t neighbor, const Point& normal) const {
  const double square = dot(normal, normal);
  return 0.5 * (square + (here_[3] - mesh_.sites()[neighbor][3])) / square;
}

/// Adds the cone from the site over a wall.
template <int D>
void CellEvaluator<D>::add_cone(double level, const WallSums& sums) {
  constexpr double one = D == 3 ? 1.0 / 6 : 1.0 / 2, x = D == 3 ? 1.0 / 24 : 1.0 / 6,
                   square = D == 3 ? 1.0 / 120 : 1.0 / 12;
  moments_[0] += level * one * sums.one;
  for (std::size_t k = 0; k < D; ++k) moments_[1 + k] += level * x * sums.x[k];
  moments_[D + 1] += level * square * sums.square;
}

template <int D>
void CellEvaluator<D>::add_wall(std::uint32_t neighbor, const WallSums& sums) {
  const Point normal = normal_of(neighbor);
  add_cone(level_of(neighbor, normal), sums);
  neighbors_.push_back(neighbor);
  const double area = sums.one / norm(normal) / (D - 1);
  walls_.push_back(std::max(area, next_to_nothing * (D == 3 ? reach_ * reach_ : reach_)));
}

template <int D>
double CellEvaluator<D>::least_measure() const {
  return plainly_solid * reach_ * reach_ * (D == 3 ? reach_ : 1);
}

/// \return whether the cell is large enough for its measures to be right
template <int D>
bool CellEvaluator<D>::sum_inside(const CellGraph& graph) {
  const std::uint8_t* loop = graph.loop.data();
  for (std::size_t f = 0; f < graph.neighbors.size(); ++f) {
    if (mesh_.is_frame(graph.neighbors[f])) return false;
    const Point normal = normal_of(graph.neighbors[f]);
    WallSums sums;
    if constexpr (D == 3) {
      const std::size_t count = graph.loop_size[f];
      sum_loop(vertices_.data(), loop, count, normal, sums);
      loop += count;
    } else {
      sums.add_edge(vertices_[f], vertices_[f + 1 == vertices_.size() ? 0 : f + 1], normal);
    }
    add_wall(graph.neighbors[f], sums);
  }
  return is_plain();
}

template <int D>
void CellEvaluator<D>::find_faces_of_vertices(const CellGraph& graph) {
  faces_of_.assign(vertices_.size(), {});
  normals_.clear();
  offsets_.clear();
  const std::uint8_t* loop = graph.loop.data();
  for (std::size_t f = 0; f < graph.neighbors.size(); ++f) {
    for (std::size_t k = 0; k < graph.loop_size[f]; ++k, ++loop) {
      auto& faces = faces_of_[*loop];
      faces[++faces[0]] = static_cast<std::uint8_t>(f);
    }
    const Point normal = normal_of(graph.neighbors[f]);
    normals_.push_back(normal);
    offsets_.push_back(level_of(graph.neighbors[f], normal) * dot(normal, normal));
  }
}

/// Where the facet cuts the edge of a face. \return false if rounding leaves too little of the point
template <int D>
bool CellEvaluator<D>::cross_edge(std::size_t face, std::uint8_t from, std::uint8_t to, Point& point) const {
  constexpr double least_determinant = 1e-6;
  std::size_t beside = face;
  for (std::size_t i = 1; i <= 3; ++i)
    for (std::size_t j = 1; j <= 3; ++j)
      if (faces_of_[from][i] == faces_of_[to][j] && faces_of_[from][i] != face) beside = faces_of_[from][i];
  if (beside == face) return false;
  // In the same order from both faces, for the same point.
  const auto [a, b] = std::minmax(face, beside);
  const Point &p = normals_[a], &q = normals_[b], &n = facet_.normal;
  const Point pq = cross(p, q);
  const double determinant = dot(pq, n);
  if (!(std::fabs(determinant) > least_determinant * std::sqrt(dot(p, p) * dot(q, q)))) return false;
  point = 1 / determinant * (offsets_[a] * cross(q, n) + offsets_[b] * cross(n, p) + room_ * pq);
  return true;
}

/// Adds the part of a wall within the facet to `sums`, and the triangle of the facet along it to cap_.
template <int D>
bool CellEvaluator<D>::cut_loop(const CellGraph& graph, std::size_t face, const std::uint8_t* loop,
                                WallSums& sums) {
  const std::size_t count = graph.loop_size[face];
  Point leave{}, enter{};
  std::size_t last = count;  // the vertex inside after which the loop leaves
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint8_t from = loop[k], to = loop[k + 1 == count ? 0 : k + 1];
    if (outside_[from] == outside_[to]) continue;
    if (!cross_edge(face, from, to, outside_[to] != 0 ? leave : enter)) return false;
    if (outside_[to] != 0) {
      if (last != count) return false;  // no convex loop leaves twice
      last = k;
    }
  }
  if (last == count) return false;
  const Point &top = leave, &normal = normals_[face];
  sums.add_triangle(top, enter, enter, normal);
  Point before = enter;
  for (std::size_t k = last + 1; k <= last + count; ++k) {
    const std::uint8_t v = loop[k % count];
    if (outside_[v] != 0) continue;
    sums.add_triangle(top, before, vertices_[v], normal);
    before = vertices_[v];
  }
  if (!has_cap_) cap_top_ = leave;
  has_cap_ = true;
  cap_.add_triangle(cap_top_, enter, leave, facet_.normal);
  return true;
}

/// Of a cell that one facet of the domain cuts. \return whether its measures are right
template <int D>
bool CellEvaluator<D>::sum_cut(const CellGraph& graph) {
  if (D == 2) return false;
  find_faces_of_vertices(graph);
  cap_ = {};
  has_cap_ = false;
  const std::uint8_t* loop = graph.loop.data();
  for (std::size_t f = 0; f < graph.neighbors.size(); loop += graph.loop_size[f++]) {
    const std::size_t count = graph.loop_size[f];
    std::size_t outside = 0;
    for (std::size_t k = 0; k < count; ++k) outside += outside_[loop[k]];
    if (outside == count) continue;
    if (mesh_.is_frame(graph.neighbors[f])) return false;
    WallSums sums;
    if (outside > 0) {
      if (!cut_loop(graph, f, loop, sums)) return false;
    } else {
      sum_loop(vertices_.data(), loop, count, normals_[f], sums);
    }
    add_wall(graph.neighbors[f], sums);
  }
  add_cone(room_, cap_);
  return is_plain();
}

template <int D>
bool CellEvaluator<D>::clip(std::span<const std::uint32_t> neighbors) {
  was_clipped_ = true;
  walls_.clear();
  neighbors_.assign(neighbors.begin(), neighbors.end());
  std::erase_if(neighbors_, [&](std::uint32_t neighbor) { return mesh_.is_frame(neighbor); });
  piece_.clear();
  const int status = clipper_->clip_by(site_, 0, neighbors_, {moments_.data(), D + 2}, piece_);
  if (status == PIECE_FLAT || clipper_->met_tie()) throw MeshUnusable();
  neighbors_.clear();
  if (status == PIECE_EMPTY) return false;
  for (std::size_t f = 0; f < piece_.border.size(); ++f)
    if (piece_.border[f] >= 0) {
      neighbors_.push_back(static_cast<std::uint32_t>(piece_.border[f]));
      walls_.push_back(piece_.wall[f]);
    }
  return true;
}

template <int D>
bool CellEvaluator<D>::evaluate(std::uint32_t site) {
  was_clipped_ = false;
  if (mesh_.simplex_at(site) == mesh_.none) return false;
  site_ = site;
  here_ = mesh_.sites()[site];
  const CellGraph graph = graphs_.graph(site, mesh_.is_changed(site));
  if (graph.vertices.empty()) return clip(graphs_.neighbors());
  find_vertices(graph);
  const Place place = error_ <= most_error[D - 2] * reach_ ? find_place() : Place::unclear;
  if (place == Place::outside) return false;
  neighbors_.clear();
  walls_.clear();
  moments_ = {};
  if (place == Place::inside && sum_inside(graph)) return true;
  if (place == Place::cut && sum_cut(graph)) return true;
  return clip(graph.neighbors);
}

template class CellEvaluator<2>;
template class CellEvaluator<3>;

}  // namespace powercell
