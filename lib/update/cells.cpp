#include "lib/update/cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/layout.h"
#include "lib/base/vectors.hpp"
#include "lib/domain/region_mesh.hpp"

namespace powercell {
namespace {

using Point = Vector3<double>;

constexpr double unit = std::numeric_limits<double>::epsilon();
/// Of the cell's radius, the largest error of a vertex that is used: as it lies along the common line of
/// planes that are nearly dependent, measures hardly depend on it.
constexpr double most_error = 1e-8;
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
void CellEvaluator<D>::start(std::uint32_t site) {
  if (simplex_mark_.size() < mesh_.simplex_count()) simplex_mark_.resize(mesh_.simplex_count(), {0, 0});
  if (site_mark_.size() < mesh_.sites().size()) site_mark_.resize(mesh_.sites().size(), {0, 0});
  if (++cell_ == 0) {  // all numbers are used up
    std::fill(simplex_mark_.begin(), simplex_mark_.end(), Mark{0, 0});
    std::fill(site_mark_.begin(), site_mark_.end(), Mark{0, 0});
    cell_ = 1;
  }
  site_ = site;
  here_ = mesh_.sites()[site];
  meets_frame_ = was_clipped_ = false;
  reach_ = error_ = 0;
  vertices_.clear();
  sums_.clear();
  neighbors_.clear();
  walls_.clear();
}

template <int D>
std::uint32_t CellEvaluator<D>::vertex_of(std::uint32_t simplex) {
  Mark& mark = simplex_mark_[simplex];
  if (mark.cell == cell_) return mark.place;
  mark = {cell_, static_cast<std::uint32_t>(vertices_.size())};
  const Center& center = centers_[simplex];
  const Site& origin = mesh_.sites()[mesh_.simplex(simplex).corner[0]];
  Vertex vertex{{}, simplex};
  for (std::size_t k = 0; k < 3; ++k) vertex.at[k] = (origin[k] - here_[k]) + center.at[k];
  reach_ = std::max(reach_, dot(vertex.at, vertex.at));
  error_ = std::max(error_, center.error);
  vertices_.push_back(vertex);
  return mark.place;
}

template <int D>
std::uint32_t CellEvaluator<D>::wall_with(std::uint32_t other, std::uint32_t vertex) {
  Mark& mark = site_mark_[other];
  if (mark.cell == cell_) return mark.place;
  mark = {cell_, static_cast<std::uint32_t>(sums_.size())};
  const Site& there = mesh_.sites()[other];
  sums_.push_back({other, vertex, {there[0] - here_[0], there[1] - here_[1], there[2] - here_[2]}, 0, 0, {}});
  meets_frame_ = meets_frame_ || mesh_.is_frame(other);
  return mark.place;
}

template <int D>
void CellEvaluator<D>::add_triangle(Wall& wall, const Vertex& from, const Vertex& to) {
  const Point &top = vertices_[wall.first].at, s = top + from.at + to.at;
  const double part = dot(cross(from.at - top, to.at - top), wall.normal);
  wall.sum += part;
  wall.squares += part * (dot(top, top) + dot(from.at, from.at) + dot(to.at, to.at) + dot(s, s));
  for (std::size_t k = 0; k < 3; ++k) wall.first_sums[k] += part * s[k];
}

/// Goes from a vertex along the edges that follow it on its walls.
template <int D>
void CellEvaluator<D>::visit(std::uint32_t vertex) {
  const auto& simplex = mesh_.simplex(vertices_[vertex].simplex);
  const std::size_t own = mesh_.index_of(simplex.corner, site_);
  for (std::size_t p = 0; p < D; ++p) {
    std::size_t at, leave;  // the wall's corner, and the one opposite the facet of its next edge
    if constexpr (D == 3) {
      at = tetrahedron_facet[own][p];
      leave = tetrahedron_facet[own][(p + 1) % 3];
    } else {
      at = (own + 1 + p) % 3;
      leave = (own + 2 - p) % 3;
    }
    const std::uint32_t wall = wall_with(simplex.corner[at], vertex);
    const typename DualMesh<D>::Facet next = simplex.across[leave];
    if (next == mesh_.outside) continue;  // a facet of the frame, at a corner of it
    const std::uint32_t to = vertex_of(next / 4);
    if constexpr (D == 3) {
      if (sums_[wall].first != vertex && sums_[wall].first != to)
        add_triangle(sums_[wall], vertices_[vertex], vertices_[to]);
    } else if (p == 1) {
      const Point &a = vertices_[vertex].at, &b = vertices_[to].at, &q = sums_[wall].normal;
      const double length = q[0] * (b[1] - a[1]) - q[1] * (b[0] - a[0]);
      sums_[wall].sum = length;
      sums_[wall].first_sums = length * (a + b);
      sums_[wall].squares = length * (dot(a, a) + dot(b, b) + dot(a, b));
    }
  }
}

template <int D>
bool CellEvaluator<D>::is_inside() const {
  const Point here{here_[0], here_[1], here_[2]};
  const double reach = std::sqrt(reach_) * (1 + 8 * unit),
               margin = error_ + 16 * unit * (reach + bounds_.size + norm(here));
  for (const ConvexBounds::Plane& plane : bounds_.planes) {
    const double room = plane.offset - dot(plane.normal, here) - margin;
    if (reach < room) continue;
    for (const Vertex& v : vertices_)
      if (!(dot(plane.normal, v.at) < room)) return false;
  }
  return true;
}

/// \return whether the cell is large enough for its measures to be right
template <int D>
bool CellEvaluator<D>::sum_walls() {
  moments_ = {};
  const double reach = std::sqrt(reach_);
  for (const Wall& wall : sums_) {
    const double square = dot(wall.normal, wall.normal), length = std::sqrt(square),
                 level = 0.5 * (square + here_[3] - mesh_.sites()[wall.site][3]) / square;
    double area = wall.sum / length;
    if constexpr (D == 3) {
      area *= 0.5;
      moments_[0] += level * wall.sum / 6;
      moments_[D + 1] += level * wall.squares / 120;
      for (std::size_t k = 0; k < 3; ++k) moments_[1 + k] += level * wall.first_sums[k] / 24;
    } else {
      moments_[0] += level * wall.sum / 2;
      moments_[D + 1] += level * wall.squares / 12;
      for (std::size_t k = 0; k < 2; ++k) moments_[1 + k] += level * wall.first_sums[k] / 6;
    }
    neighbors_.push_back(wall.site);
    walls_.push_back(std::max(area, next_to_nothing * (D == 3 ? reach_ : reach)));
  }
  return moments_[0] > plainly_solid * reach_ * (D == 3 ? reach : 1);
}

template <int D>
bool CellEvaluator<D>::clip() {
  was_clipped_ = true;
  neighbors_.clear();
  walls_.clear();
  for (const Wall& wall : sums_)
    if (!mesh_.is_frame(wall.site)) neighbors_.push_back(wall.site);
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
  start(site);
  if (mesh_.simplex_at(site) == mesh_.none) return false;
  vertex_of(mesh_.simplex_at(site));
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) visit(v);
  const bool is_certain = !meets_frame_ && error_ * error_ <= most_error * most_error * reach_ && is_inside();
  if (is_certain && sum_walls()) return true;
  return clip();
}

template class CellEvaluator<2>;
template class CellEvaluator<3>;

}  // namespace powercell
