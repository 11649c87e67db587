#include "lib/cell/host_polyhedron.hpp"

#include <utility>

namespace powercell {

void HostPolyhedron::start(const HostRegion& region) {
  const region_shape_t& shape = *region.shape;
  const std::vector<Point>& y = region.corner;
  points_.clear();
  links_.assign(y.size(), {});
  faces_.clear();
  mark_.clear();
  is_outside_.clear();
  facets_.assign(static_cast<std::size_t>(shape.faces), {});
  for (std::size_t v = 0; v < y.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) {
      const int next = shape.next[k][v], after = shape.next[(k + 1) % 3][v];
      links_[v].next[k] = static_cast<std::uint32_t>(next);
      links_[v].face[k] = static_cast<std::uint32_t>(shape.face[k][v]);
      HostPlane& facet = facets_[links_[v].face[k]];
      if (facet.error != 0) continue;
      const Point a = y[static_cast<std::size_t>(next)] - y[v], b = y[static_cast<std::size_t>(after)] - y[v];
      facet = plane_of_facet(y[v], a, b, region.corner_error);
    }
  for (const Point& corner : y) points_.push_back({corner, region.corner_error});
  for (const HostPlane& plane : facets_) faces_.push_back({~static_cast<std::int32_t>(faces_.size()), plane});
}

HostPoint HostPolyhedron::place_vertex(const HostPlacer& place, const Links& face) const {
  const HostFace &a = faces_[face[0]], &b = faces_[face[1]], &c = faces_[face[2]];
  return place({a.border, b.border, c.border}, a.plane, b.plane, c.plane);
}

/// Lists the edges that lead from vertices outside to vertices inside.
void HostPolyhedron::find_crossings(std::span<const std::uint32_t> outside) {
  is_outside_.resize(size(), 0);
  crossings_.clear();
  for (const std::uint32_t v : outside) is_outside_[v] = 1;
  for (const std::uint32_t v : outside) {
    const auto& [next, face] = links_[v];
    for (std::size_t k = 0; k < 3; ++k)
      if (is_outside_[next[k]] == 0)
        crossings_.push_back({next[k], slot_of(links_[next[k]].next, v), face[k], face[(k + 2) % 3]});
  }
  for (const std::uint32_t v : outside) is_outside_[v] = 0;
}

/// Joins the new vertices, starting from `first`, around the new face.
/// \return whether they form one loop
bool HostPolyhedron::link_loop(std::uint32_t first) {
  std::size_t length = 0;
  std::uint32_t u = first;
  do {
    std::uint32_t& mark = mark_[links_[u].face[0]];
    const std::uint32_t along = mark;
    if (along == none) return false;
    mark = none;
    links_[u].next[1] = along;
    links_[along].next[2] = u;
    u = along;
    ++length;
  } while (u != first);
  return length == crossings_.size();
}

/// Removes vertex v; the last vertex takes its number.
void HostPolyhedron::remove(std::uint32_t v) {
  const auto last = static_cast<std::uint32_t>(size() - 1);
  if (v != last) {
    points_[v] = points_[last];
    links_[v] = links_[last];
    for (const std::uint32_t u : links_[v].next) links_[u].next[slot_of(links_[u].next, last)] = v;
    changed_.push_back(v);
  }
  points_.pop_back();
  links_.pop_back();
}

bool HostPolyhedron::cut(std::span<const std::uint32_t> outside, const HostFace& face,
                         const HostPlacer& place) {
  const auto cut = static_cast<std::uint32_t>(faces_.size());
  find_crossings(outside);
  if (crossings_.size() < 3) return false;
  faces_.push_back(face);
  mark_.resize(faces_.size(), none);
  slots_.assign(outside.begin(), outside.end());
  for (std::size_t k = 0; k < crossings_.size(); ++k) {  // new vertices take the numbers of those outside
    const auto& [kept, slot, right, left] = crossings_[k];
    if (k == slots_.size()) {
      slots_.push_back(static_cast<std::uint32_t>(size()));
      points_.emplace_back();
      links_.emplace_back();
    }
    const std::uint32_t v = slots_[k];
    links_[v] = {{kept, none, none}, {right, cut, left}};
    points_[v] = place_vertex(place, links_[v].face);
    links_[kept].next[slot] = v;
    mark_[left] = v;
  }
  if (!link_loop(slots_[0])) return false;
  changed_.assign(slots_.begin(), slots_.begin() + static_cast<std::ptrdiff_t>(crossings_.size()));
  for (std::size_t k = slots_.size(); k-- > crossings_.size();) remove(slots_[k]);
  return true;
}

/// Numbers the remaining faces; the mark of each is its first vertex.
void HostPolyhedron::number_faces() {
  std::vector<std::uint32_t> number(faces_.size(), none);
  for (const Vertex& vertex : links_)
    for (const std::uint32_t f : vertex.face) number[f] = 0;
  std::uint32_t count = 0;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (number[f] == none) continue;
    number[f] = count;
    faces_[count++] = faces_[f];
  }
  faces_.resize(count);
  mark_.resize(count);
  for (auto v = static_cast<std::uint32_t>(size()); v-- > 0;)
    for (std::uint32_t& f : links_[v].face) {
      f = number[f];
      mark_[f] = v;
    }
}

/// Face order[k] becomes face k. Vertices go by their faces, of which the first comes first in each.
void HostPolyhedron::reorder(const std::vector<std::uint32_t>& order) {
  std::vector<HostFace> faces;
  for (std::uint32_t k = 0; k < order.size(); ++k) {
    faces.push_back(faces_[order[k]]);
    mark_[order[k]] = k;
  }
  faces_ = std::move(faces);
  std::vector<std::pair<Links, std::uint32_t>> rows;  // faces of a vertex, and its number
  for (std::uint32_t v = 0; v < size(); ++v) {
    auto& [next, face] = links_[v];
    for (std::uint32_t& f : face) f = mark_[f];
    const auto turn = std::min_element(face.begin(), face.end()) - face.begin();
    std::rotate(face.begin(), face.begin() + turn, face.end());
    std::rotate(next.begin(), next.begin() + turn, next.end());
    rows.emplace_back(face, v);
  }
  std::sort(rows.begin(), rows.end());
  std::vector<std::uint32_t> number(size());
  for (std::uint32_t v = 0; v < size(); ++v) number[rows[v].second] = v;
  std::vector<HostPoint> points;
  std::vector<Vertex> links;
  for (const auto& [face, v] : rows) {
    points.push_back(points_[v]);
    links.push_back(links_[v]);
    for (std::uint32_t& u : links.back().next) u = number[u];
  }
  points_ = std::move(points);
  links_ = std::move(links);
}

void HostPolyhedron::finish(const HostPlacer& place) {
  number_faces();
  for (std::size_t v = 0; v < size(); ++v) {
    const ExactVertex b = borders(v);
    if (b[0] >= 0 || b[1] >= 0 || b[2] >= 0) points_[v] = place_vertex(place, links_[v].face);
  }
}

std::array<double, 5> HostPolyhedron::moments() {
  area_.assign(faces_.size(), 0);
  std::array<double, 5> sum{};
  const Point& top = points_[0].at;
  for (std::size_t v = 0; v < size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t f = links_[v].face[k];
      const Point &a = points_[mark_[f]].at, &b = points_[v].at, &c = points_[links_[v].next[k]].at;
      const Point &normal = faces_[f].plane.normal, s = top + a + (b + c);
      const double area = dot(cross(b - a, c - a), normal), part = area * dot(normal, a - top);
      area_[f] += area / 2;
      sum[0] += part / 6;
      for (std::size_t i = 0; i < 3; ++i) sum[1 + i] += part * s[i] / 24;
      sum[4] += part * (dot(top, top) + dot(a, a) + dot(b, b) + dot(c, c) + dot(s, s)) / 120;
    }
  for (double& area : area_) area = std::fabs(area);
  return sum;
}

void HostPolyhedron::write_vertices(PieceBatch& row, std::size_t) const {
  for (std::size_t v = 0; v < size(); ++v) {
    row.vertex.insert(row.vertex.end(), points_[v].at.begin(), points_[v].at.end());
    for (const Links& links : {links_[v].next, links_[v].face})
      row.link.insert(row.link.end(), links.begin(), links.end());
  }
}

}  // namespace powercell
