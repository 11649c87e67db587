#include "lib/solid/cell_in_solid.hpp"

#include <algorithm>
#include <cmath>

namespace powercell::solid {
namespace {

/// Of cells with more faces edges are looked up in a hash table.
constexpr std::size_t most_tabulated = 128;

/// Least measure, and least area of a wall, whose sign is beyond doubt and whose digits are worth having, in
/// units of the extent squared times the distance from the seed, and of the extent times that distance.
constexpr double least_measure = 0x1p-28, least_area = 0x1p-36;
/// The same for those that are rounding errors alone.
constexpr double rounding = 0x1p-42;

}  // namespace

void CellInSolid::start(std::uint32_t rank, const WholeCell& cell, std::span<const double> positions) {
  rank_ = rank;
  cell_ = cell;
  positions_ = positions;
  ring_.clear();
  ring_end_.clear();
  edge_point_.clear();
  edge_point_number_.clear();
  face_number_.clear();
  for (std::uint32_t f = 0; f < cell.border.size(); ++f)
    if (cell.border[f] >= 0) face_number_.add(static_cast<std::uint32_t>(cell.border[f]), f);
  unknown_border_ = uniform_ = false;
  first_.assign(cell.border.size(), none);
  for (auto v = static_cast<std::uint32_t>(cell.vertices()); v-- > 0;)
    for (std::size_t k = 0; k < 3; ++k) first_[cell.link[6 * std::size_t{v} + 3 + k]] = v;
}

void CellInSolid::add(const BoundaryPiece& piece) {
  const std::size_t count = piece.border.size(), first = ring_.size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t face =
        piece.border[k] < 0 ? none : face_number_.find(static_cast<std::uint32_t>(piece.border[k]));
    if (piece.border[k] >= 0 && face == none) unknown_border_ = true;
    ring_.push_back({{piece.vertex[3 * k], piece.vertex[3 * k + 1], piece.vertex[3 * k + 2]}, face, none});
  }
  ring_end_.push_back(ring_.size());
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t before = k == 0 ? count - 1 : k - 1;
    if ((piece.border[before] < 0) == (piece.border[k] < 0)) continue;
    const bool comes_in_wall = piece.border[before] >= 0;
    const std::uint32_t face = ring_[first + (comes_in_wall ? before : k)].face,
                        edge =
                            piece.edges[static_cast<std::size_t>(~piece.border[comes_in_wall ? k : before])];
    RingVertex& vertex = ring_[first + k];
    const std::uint64_t key = std::uint64_t{edge} << 32 | face;
    vertex.edge_point = edge_point_number_.find(key);
    if (vertex.edge_point == none) {
      vertex.edge_point = static_cast<std::uint32_t>(edge_point_.size());
      edge_point_number_.add(key, vertex.edge_point);
      edge_point_.push_back(vertex.at);
    } else {
      vertex.at = edge_point_[vertex.edge_point];
    }
  }
}

double CellInSolid::piece_area(std::size_t k) const {
  const std::size_t first = k == 0 ? 0 : ring_end_[k - 1];
  Point twice{};
  for (std::size_t v = first + 2; v < ring_end_[k]; ++v)
    twice = twice + cross(ring_[v - 1].at - ring_[first].at, ring_[v].at - ring_[first].at);
  return norm(twice) / 2;
}

void CellInSolid::number_edges() {
  const std::size_t faces = cell_.border.size();
  const bool few = faces <= most_tabulated;
  edge_number_.assign(few ? faces * faces : 0, none);
  edge_of_many_.clear();
  for (std::uint32_t edge = 0; edge < 3 * cell_.vertices(); ++edge) {
    if (few)
      edge_number_[left(edge) * faces + right(edge)] = edge;
    else
      edge_of_many_.add(std::uint64_t{left(edge)} << 32 | right(edge), edge);
  }
}

std::uint32_t CellInSolid::edge_between(std::uint32_t left_face, std::uint32_t right_face) const {
  if (edge_number_.empty()) return edge_of_many_.find(std::uint64_t{left_face} << 32 | right_face);
  return edge_number_[left_face * cell_.border.size() + right_face];
}

std::uint32_t CellInSolid::opposite(std::uint32_t edge) const {
  const std::uint32_t v = edge / 3, there = 3 * next(edge);
  return next(there) == v ? there : next(there + 1) == v ? there + 1 : there + 2;
}

bool CellInSolid::add_crossing(std::size_t before, std::size_t k) {
  if (ring_[before].face == none || ring_[k].face == none) return true;
  const std::uint32_t edge = edge_between(ring_[before].face, ring_[k].face);
  if (edge == none) return false;
  const std::uint32_t back = opposite(edge);
  ++net_[edge];
  --net_[back];
  crossings_.push_back(is_lower(edge) ? Crossing{edge, 1, ring_[k].at} : Crossing{back, -1, ring_[k].at});
  return true;
}

bool CellInSolid::find_crossings() {
  if (unknown_border_) return false;
  number_edges();
  crossings_.clear();
  net_.assign(3 * cell_.vertices(), 0);
  std::size_t first = 0;
  for (const std::size_t last : ring_end_) {
    for (std::size_t k = first; k < last; ++k)
      if (!add_crossing(k == first ? last - 1 : k - 1, k)) return false;
    first = last;
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
      if (net_[edge] == 0 && !set_side(u, side_[v])) return false;
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

void CellInSolid::add_wall_edge(std::uint32_t f, const Point& from, const Point& to) {
  if (!walls_[f].cut) {
    walls_[f].cut = true;
    walls_[f].base = from;
  }
  add_segment(f, to, from, 1);
}

void CellInSolid::add_piece(std::size_t first, std::size_t last) {
  const Point a = ring_[first].at - origin_;
  Point b = a;
  for (std::size_t k = first; k < last; ++k) {
    reach_ = std::max(reach_, dot(ring_[k].at, ring_[k].at));
    const Point c = k + 1 == last ? a : ring_[k + 1].at - origin_;
    if (k > first && k + 1 < last) add_tetrahedron(a, b, c, dot(a, cross(b - a, c - a)));
    if (ring_[k].face != none) add_wall_edge(ring_[k].face, b, c);
    b = c;
  }
}

void CellInSolid::add_pieces() {
  std::size_t first = 0;
  for (const std::size_t last : ring_end_) {
    add_piece(first, last);
    first = last;
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
  origin_ = ring_.front().at;
  walls_.assign(cell_.border.size(), {});
  for (std::uint32_t f = 0; f < walls_.size(); ++f)
    if (first_[f] != none) walls_[f].base = vertex(first_[f]) - origin_;
  for (std::uint32_t v = 0; v < side_.size(); ++v)
    if (side_[v] == Side::inside) reach_ = std::max(reach_, dot(vertex(v), vertex(v)));
  SolidPart part;
  add_pieces();
  add_edges();
  reach_ = std::sqrt(reach_);
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
    const double unit = extent * (extent + reach_);
    if (!(area > least_area * unit)) part.thin = true;
    if (!(area > rounding * unit)) continue;
    part.neighbors.push_back(neighbor);
    part.areas.push_back(area);
  }
}

void CellInSolid::finish_moments(SolidPart& part) const {
  const double measure = six_volumes_ / 6;
  const Point first = 1.0 / 24 * first_moment_;
  const double far = std::sqrt(extent_) + reach_;
  if (!(measure > least_measure * extent_ * far)) part.thin = true;
  if (!(measure > rounding * extent_ * far)) part.flat = true;
  part.moments[0] = measure;
  for (std::size_t k = 0; k < 3; ++k) part.moments[1 + k] = first[k] + measure * origin_[k];
  part.moments[4] = second_ / 120 + 2 * dot(origin_, first) + measure * dot(origin_, origin_);
}

}  // namespace powercell::solid
