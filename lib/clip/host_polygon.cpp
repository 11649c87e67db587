#include "lib/clip/host_polygon.hpp"

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
}

bool HostPolygon::cut(const std::vector<double>& side, const HostFace& line, const HostPlacer& place) {
  const auto vertex = [&](std::size_t, std::size_t, const HostFace& in, const HostFace& out) {
    return meet(place, ground_, in, out);
  };
  return cut_ring(ring_, side, line, vertex, other_) == 1;
}

void HostPolygon::finish(const HostPlacer& place) {
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
