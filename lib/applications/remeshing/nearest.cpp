#include "lib/applications/remeshing/nearest.hpp"

#include <algorithm>
#include <limits>

#include "lib/applications/remeshing/triangle.hpp"

namespace powercell::remeshing {
namespace {

double coordinate(Vec v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

Vec sum(const std::array<Vec, 3>& t) {
  return t[0] + t[1] + t[2];
}

}  // namespace

NearestPoint::NearestPoint(std::vector<std::array<Vec, 3>> triangles) : triangle_(std::move(triangles)) {
  node_.reserve(triangle_.size());
  build(0, static_cast<std::uint32_t>(triangle_.size()));
}

void NearestPoint::build(std::uint32_t begin, std::uint32_t end) {
  constexpr double most = std::numeric_limits<double>::max();
  Node node{{{most, most, most}, {-most, -most, -most}}, begin, end, 0};
  for (std::uint32_t t = begin; t < end; ++t)
    for (const Vec v : triangle_[t]) {
      Vec &low = node.box.low, &high = node.box.high;
      low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
      high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
  const std::size_t here = node_.size();
  node_.push_back(node);
  if (end - begin <= 4) return;
  const Vec extent = node.box.high - node.box.low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::uint32_t t) { return triangle_.begin() + t; };
  std::nth_element(at(begin), at(middle), at(end), [&](const auto& a, const auto& b) {
    return coordinate(sum(a), axis) < coordinate(sum(b), axis);
  });
  build(begin, middle);
  node_[here].second = static_cast<std::uint32_t>(node_.size());
  build(middle, end);
}

double NearestPoint::distance2(const Box& box, Vec x) {
  const auto outside = [](double v, double low, double high) {
    return v < low ? low - v : v > high ? v - high : 0;
  };
  const Vec d{outside(x.x, box.low.x, box.high.x), outside(x.y, box.low.y, box.high.y),
              outside(x.z, box.low.z, box.high.z)};
  return norm2(d);
}

double NearestPoint::distance2(Vec x) const {
  double least = std::numeric_limits<double>::infinity();
  struct Entry {
    std::uint32_t node;
    double distance;
  };
  std::array<Entry, 128> stack;  // two per level; a balanced tree has at most 32 levels
  std::size_t size = 0;
  stack[size++] = {0, distance2(node_[0].box, x)};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.distance >= least) continue;
    const Node& node = node_[entry.node];
    if (node.second == 0) {
      for (std::uint32_t t = node.begin; t < node.end; ++t) {
        const auto& [a, b, c] = triangle_[t];
        least = std::min(least, norm2(nearest_in_triangle(x, a, b, c) - x));
      }
      continue;
    }
    const Entry first{entry.node + 1, distance2(node_[entry.node + 1].box, x)};
    const Entry second{node.second, distance2(node_[node.second].box, x)};
    const bool first_nearer = first.distance < second.distance;
    stack[size++] = first_nearer ? second : first;
    stack[size++] = first_nearer ? first : second;
  }
  return least;
}

}  // namespace powercell::remeshing
