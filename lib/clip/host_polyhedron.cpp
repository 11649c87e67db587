#include "lib/clip/host_polyhedron.hpp"

namespace powercell {

void HostPolyhedron::start(const HostRegion& region) {
  const region_shape_t& shape = *region.shape;
  const std::vector<Point>& y = region.corner;
  points_.clear();
  links_.assign(y.size(), {});
  faces_.clear();
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

/// Lists the vertices outside and the edges that lead from them to vertices inside.
void HostPolyhedron::find_crossings(const std::vector<double>& side) {
  outside_.clear();
  crossings_.clear();
  for (std::uint32_t v = 0; v < side.size(); ++v) {
    if (side[v] < 0) continue;
    outside_.push_back(v);
    const auto& [next, face] = links_[v];
    for (std::size_t k = 0; k < 3; ++k)
      if (side[next[k]] < 0)
        crossings_.push_back({next[k], slot_of(links_[next[k]].next, v), face[k], face[(k + 2) % 3]});
  }
}

/// Joins the new vertices, starting from `first`, around the new face. \return whether they form one loop
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
  }
  points_.pop_back();
  links_.pop_back();
}

bool HostPolyhedron::cut(const std::vector<double>& side, const HostFace& face, const HostPlacer& place) {
  const auto cut = static_cast<std::uint32_t>(faces_.size());
  find_crossings(side);
  if (crossings_.size() < 3) return false;
  faces_.push_back(face);
  mark_.assign(faces_.size(), none);
  for (std::size_t k = 0; k < crossings_.size(); ++k) {  // new vertices take the numbers of those outside
    const auto& [kept, slot, right, left] = crossings_[k];
    if (k == outside_.size()) {
      outside_.push_back(static_cast<std::uint32_t>(size()));
      points_.emplace_back();
      links_.emplace_back();
    }
    const std::uint32_t v = outside_[k];
    links_[v] = {{kept, none, none}, {right, cut, left}};
    points_[v] = place_vertex(place, links_[v].face);
    links_[kept].next[slot] = v;
    mark_[left] = v;
  }
  if (!link_loop(outside_[0])) return false;
  for (std::size_t k = outside_.size(); k-- > crossings_.size();) remove(outside_[k]);
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
