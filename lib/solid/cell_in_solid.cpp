#include "lib/solid/cell_in_solid.hpp"

#include <algorithm>
#include <cmath>

namespace powercell::solid {
namespace {

constexpr std::uint32_t none = ~std::uint32_t{0};

/// Least measure, and least area of a wall, whose sign is beyond doubt and whose digits are worth having, in
/// units of the extent squared times the distance from the seed, and of the extent times that distance.
constexpr double least_measure = 0x1p-28, least_area = 0x1p-36;

Point point_of(const BoundaryPiece& piece, std::size_t k) {
  return {piece.vertex[3 * k], piece.vertex[3 * k + 1], piece.vertex[3 * k + 2]};
}

std::size_t after(const BoundaryPiece& piece, std::size_t k) {
  return k + 1 == piece.border.size() ? 0 : k + 1;
}

}  // namespace

void CellInSolid::start(std::uint32_t rank, const WholeCell& cell, std::span<const double> positions) {
  rank_ = rank;
  cell_ = cell;
  positions_ = positions;
  pieces_.clear();
  uniform_ = false;
  first_.assign(cell.border.size(), none);
  for (auto v = static_cast<std::uint32_t>(cell.vertices()); v-- > 0;)
    for (std::size_t k = 0; k < 3; ++k) first_[cell.link[6 * std::size_t{v} + 3 + k]] = v;
}

std::uint32_t CellInSolid::face_of(std::int32_t border) const {
  const auto found = std::find(cell_.border.begin(), cell_.border.end(), border);
  return found == cell_.border.end() ? none : static_cast<std::uint32_t>(found - cell_.border.begin());
}

std::uint32_t CellInSolid::edge_between(std::uint32_t left_face, std::uint32_t right_face) const {
  for (std::uint32_t edge = 0; edge < 3 * cell_.vertices(); ++edge)
    if (left(edge) == left_face && right(edge) == right_face) return edge;
  return none;
}

bool CellInSolid::add_crossing(const BoundaryPiece& piece, std::size_t k) {
  const std::int32_t in = piece.border[k == 0 ? piece.border.size() - 1 : k - 1], out = piece.border[k];
  if (in < 0 || out < 0) return true;
  const std::uint32_t left_face = face_of(in), right_face = face_of(out);
  if (left_face == none || right_face == none) return false;
  std::uint32_t edge = edge_between(left_face, right_face);
  int leaves = 1;
  if (edge != none && !is_lower(edge)) {
    edge = edge_between(right_face, left_face);
    leaves = -1;
  }
  if (edge == none) return false;
  net_[edge] += leaves;
  crossings_.push_back({edge, leaves, point_of(piece, k)});
  return true;
}

bool CellInSolid::find_crossings() {
  crossings_.clear();
  net_.assign(3 * cell_.vertices(), 0);
  for (const BoundaryPiece& piece : pieces_)
    for (std::size_t k = 0; k < piece.border.size(); ++k) {
      if (piece.border[k] >= 0 && face_of(piece.border[k]) == none) return false;
      if (!add_crossing(piece, k)) return false;
    }
  return true;
}

bool CellInSolid::set_side(std::uint32_t vertex, Side side) {
  if (side_[vertex] == Side::unknown) {
    side_[vertex] = side;
    stack_.push_back(vertex);
  }
  return side_[vertex] == side;
}

bool CellInSolid::spread() {
  while (!stack_.empty()) {
    const std::uint32_t v = stack_.back();
    stack_.pop_back();
    for (std::uint32_t edge = 3 * v; edge < 3 * v + 3; ++edge) {
      const std::uint32_t u = next(edge);
      std::uint32_t lower = edge;
      if (u < v) lower = edge_between(right(edge), left(edge));
      if (net_[lower] == 0 && !set_side(u, side_[v])) return false;
    }
  }
  return true;
}

bool CellInSolid::label() {
  side_.assign(cell_.vertices(), Side::unknown);
  stack_.clear();
  if (!find_crossings()) return false;
  for (std::uint32_t edge = 0; edge < net_.size(); ++edge) {
    if (net_[edge] == 0) continue;
    const bool leaves = net_[edge] == 1;
    if (!leaves && net_[edge] != -1) return false;
    if (!set_side(edge / 3, leaves ? Side::inside : Side::outside)) return false;
    if (!set_side(next(edge), leaves ? Side::outside : Side::inside)) return false;
  }
  uniform_ = stack_.empty();
  return spread();
}

void CellInSolid::set_sides(Side side) {
  std::fill(side_.begin(), side_.end(), side);
}

bool CellInSolid::is_open() const {
  for (std::uint32_t v = 0; v < side_.size(); ++v)
    for (std::size_t k = 0; side_[v] == Side::inside && k < 3; ++k)
      if (cell_.border[cell_.link[6 * std::size_t{v} + 3 + k]] < 0) return true;
  return false;
}

void CellInSolid::add_tetrahedron(const Point& a, const Point& b, const Point& c, double six_volumes) {
  const Point sum = a + b + c;
  six_volumes_ += six_volumes;
  first_moment_ = first_moment_ + six_volumes * sum;
  second_ += six_volumes * (dot(a, a) + dot(b, b) + dot(c, c) + dot(sum, sum));
  extent_ = std::max({extent_, dot(a, a), dot(b, b), dot(c, c)});
}

void CellInSolid::add_segment(std::uint32_t f, const Point& a, const Point& b, double sign) {
  Wall& wall = walls_[f];
  const Point to_a = a - wall.base, to_b = b - wall.base, twice_area = sign * cross(to_a, to_b);
  wall.area = wall.area + twice_area;
  wall.extent = std::max({wall.extent, dot(to_a, to_a), dot(to_b, to_b)});
  add_tetrahedron(wall.base, a, b, dot(wall.base, twice_area));
}

void CellInSolid::add_edge_segment(std::uint32_t edge, const Point& a, const Point& b, double sign) {
  add_segment(left(edge), a, b, sign);
  add_segment(right(edge), a, b, -sign);
}

void CellInSolid::add_pieces() {
  for (const BoundaryPiece& piece : pieces_) {
    const Point a = point_of(piece, 0) - origin_;
    for (std::size_t k = 2; k < piece.border.size(); ++k) {
      const Point b = point_of(piece, k - 1) - origin_, c = point_of(piece, k) - origin_;
      add_tetrahedron(a, b, c, dot(a, cross(b - a, c - a)));
    }
    for (std::size_t k = 0; k < piece.border.size(); ++k) reach_ = std::max(reach_, norm(point_of(piece, k)));
    add_walls_of(piece);
  }
}

void CellInSolid::add_walls_of(const BoundaryPiece& piece) {
  for (std::size_t k = 0; k < piece.border.size(); ++k) {
    if (piece.border[k] < 0) continue;
    const std::uint32_t f = face_of(piece.border[k]);
    const Point from = point_of(piece, k) - origin_, to = point_of(piece, after(piece, k)) - origin_;
    if (!walls_[f].cut) {
      walls_[f].cut = true;
      walls_[f].base = from;
    }
    add_segment(f, to, from, 1);
  }
}

void CellInSolid::add_edges() {
  base_.assign(net_.size(), none);
  for (std::uint32_t c = 0; c < crossings_.size(); ++c) {
    std::uint32_t& base = base_[crossings_[c].edge];
    if (base == none) base = c;
    add_edge_segment(crossings_[c].edge, crossings_[base].at - origin_, crossings_[c].at - origin_,
                     crossings_[c].leaves);
  }
  for (std::uint32_t edge = 0; edge < net_.size(); ++edge) {
    const std::uint32_t v = edge / 3, u = next(edge);
    const bool here = side_[v] == Side::inside, there = side_[u] == Side::inside;
    if (u < v || (!here && !there)) continue;
    const Point from = vertex(v) - origin_, to = vertex(u) - origin_;
    if (base_[edge] == none) {
      add_edge_segment(edge, from, to, 1);
      continue;
    }
    const Point base = crossings_[base_[edge]].at - origin_;
    if (here) add_edge_segment(edge, base, from, -1);
    if (there) add_edge_segment(edge, base, to, 1);
  }
}

SolidPart CellInSolid::part() {
  six_volumes_ = second_ = extent_ = reach_ = 0;
  first_moment_ = {};
  origin_ = point_of(pieces_.front(), 0);
  walls_.assign(cell_.border.size(), {});
  for (std::uint32_t f = 0; f < walls_.size(); ++f)
    if (first_[f] != none) walls_[f].base = vertex(first_[f]) - origin_;
  for (std::uint32_t v = 0; v < side_.size(); ++v)
    if (side_[v] == Side::inside) reach_ = std::max(reach_, norm(vertex(v)));
  SolidPart part;
  add_pieces();
  add_edges();
  finish_walls(part);
  finish_moments(part);
  return part;
}

void CellInSolid::finish_walls(SolidPart& part) {
  const double* const here = &positions_[3 * std::size_t{rank_}];
  for (std::uint32_t f = 0; f < walls_.size(); ++f) {
    if (cell_.border[f] < 0 || !(cell_.area[f] > 0)) continue;
    const auto neighbor = static_cast<std::uint32_t>(cell_.border[f]);
    if (!walls_[f].cut) {
      if (side_[first_[f]] != Side::inside) continue;
      part.neighbors.push_back(neighbor);
      part.areas.push_back(cell_.area[f]);
      continue;
    }
    const Point q = difference<double>(&positions_[3 * std::size_t{neighbor}], here);
    const double area = 0.5 * dot(q, walls_[f].area) / norm(q), extent = std::sqrt(walls_[f].extent);
    if (!(area > least_area * extent * (extent + reach_))) part.thin = true;
    part.neighbors.push_back(neighbor);
    part.areas.push_back(area);
  }
}

void CellInSolid::finish_moments(SolidPart& part) const {
  const double measure = six_volumes_ / 6;
  const Point first = 1.0 / 24 * first_moment_;
  const double far = std::sqrt(extent_) + reach_;
  if (!(measure > least_measure * extent_ * far)) part.thin = true;
  part.moments[0] = measure;
  for (std::size_t k = 0; k < 3; ++k) part.moments[1 + k] = first[k] + measure * origin_[k];
  part.moments[4] = second_ / 120 + 2 * dot(origin_, first) + measure * dot(origin_, origin_);
}

}  // namespace powercell::solid
