#include "lib/cell/host_polygon.hpp"

namespace powercell {
namespace {

HostPoint meet(const HostPlacer& place, const HostPlane& ground, const HostFace& in, const HostFace& out) {
  return place({in.border, out.border, 0}, ground, in.plane, out.plane);
}

}  // namespace

void HostPolygon::start(const HostRegion& region) {
  const std::vector<Point>& y = region.corner;
  ring_.clear();
  facets_.clear();
  ground_ = {{0, 0, 1}, 0, 0};
  if (region.on_surface) {
    const Point a = y[1] - y[0], b = y[2] - y[0];
    ground_ = plane_of_facet(y[0], a, b, region.corner_error);
  }
  const Point& n = ground_.normal;
  for (std::size_t k = 0; k < y.size(); ++k) {
    const Point along = y[k + 1 == y.size() ? 0 : k + 1] - y[k];
    facets_.push_back(plane_of_facet(y[k], along, n, region.corner_error));
    ring_.push_back({{y[k], region.corner_error}, {~static_cast<std::int32_t>(k), facets_.back()}});
  }
  first_ = 0;
  for (std::uint32_t k = 0; k < y.size(); ++k) link(k, k + 1 == y.size() ? 0 : k + 1);
}

bool HostPolygon::cut(std::span<const std::uint32_t> outside, const HostFace& line, const HostPlacer& place) {
  std::uint32_t first = 0, last = 0;
  std::size_t firsts = 0;
  for (const std::uint32_t v : outside) ring_[v].is_outside = true;
  for (const std::uint32_t v : outside) {
    if (!ring_[ring_[v].next].is_outside) last = v;
    if (ring_[ring_[v].previous].is_outside) continue;
    first = v;
    ++firsts;
  }
  if (firsts != 1) return false;
  const std::uint32_t before = ring_[first].previous, after = ring_[last].next;
  const HostFace into = ring_[last].edge;
  const std::uint32_t leaving = outside[0],
                      entering = outside.size() > 1 ? outside[1] : static_cast<std::uint32_t>(size());
  if (outside.size() == 1) ring_.emplace_back();
  if (ring_[first_].is_outside) first_ = entering;
  ring_[leaving] = {meet(place, ground_, ring_[before].edge, line), line};
  ring_[entering] = {meet(place, ground_, line, into), into};
  link(before, leaving);
  link(leaving, entering);
  link(entering, after);
  changed_ = {leaving, entering};
  for (std::size_t k = outside.size(); k-- > 2;) remove(outside[k]);
  return true;
}

/// The last vertex takes the number of v, which is not linked.
void HostPolygon::remove(std::uint32_t v) {
  const auto last = static_cast<std::uint32_t>(size() - 1);
  if (v != last) {
    ring_[v] = ring_[last];
    link(ring_[v].previous, v);
    link(v, ring_[v].next);
    changed_.push_back(v);
    if (first_ == last) first_ = v;
  }
  ring_.pop_back();
}

void HostPolygon::sharpen(std::size_t v, const HostPlacer& place) {
  ring_[v].at = place.exactly(borders(v));
}

void HostPolygon::sort_ring() {
  sorted_.clear();
  const std::uint32_t count = static_cast<std::uint32_t>(size());
  for (std::uint32_t k = 0, v = first_; k < count; ++k, v = ring_[v].next) sorted_.push_back(ring_[v]);
  ring_.swap(sorted_);
  for (std::uint32_t k = 0; k < count; ++k) link(k, k + 1 == count ? 0 : k + 1);
  first_ = 0;
}

void HostPolygon::finish(const HostPlacer& place) {
  sort_ring();
  for (std::size_t v = 0; v < size(); ++v) {
    const HostFace &in = ring_[before(v)].edge, &out = ring_[v].edge;
    if (in.border >= 0 || out.border >= 0) ring_[v].at = meet(place, ground_, in, out);
  }
}

std::array<double, 5> HostPolygon::moments() {
  std::array<double, 5> sum{};
  const Point& a = vertex(0).at;
  for (std::size_t v = 1; v + 1 < size(); ++v) {
    const Point &b = vertex(v).at, &c = vertex(v + 1).at, s = a + b + c;
    const double area = 0.5 * dot(ground_.normal, cross(b - a, c - a));
    sum[0] += area;
    for (std::size_t k = 0; k < 3; ++k) sum[1 + k] += area * s[k] / 3;
    sum[4] += area * (dot(s, s) + dot(a, a) + dot(b, b) + dot(c, c)) / 12;
  }
  return sum;
}

void HostPolygon::write_vertices(PieceBatch& row, std::size_t coordinates) const {
  for (const auto& corner : ring_)
    row.vertex.insert(row.vertex.end(), &corner.at.at[0], &corner.at.at[0] + coordinates);
}

}  // namespace powercell
