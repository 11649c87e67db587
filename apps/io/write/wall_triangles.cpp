#include "apps/io/write/wall_triangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <powercell/error.hpp>
#include <utility>

#include "apps/io/read/mesh.hpp"

namespace powercell::io {
namespace {

double twice_area(const std::vector<double>& points, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const double *o = &points[3 * std::size_t{a}], *x = &points[3 * std::size_t{b}],
               *y = &points[3 * std::size_t{c}];
  std::array<double, 3> n{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    n[axis] = (x[u] - o[u]) * (y[v] - o[v]) - (x[v] - o[v]) * (y[u] - o[u]);
  }
  return std::hypot(n[0], n[1], n[2]);
}

/// Turns the loop such that the fan from its first corner has the largest least triangle: where a corner lies
/// in a straight edge, another fan would have a triangle without area.
std::vector<std::uint32_t> best_start(const std::vector<double>& points, std::vector<std::uint32_t> loop) {
  constexpr std::size_t most_tried = 64;
  double best = -1;
  std::size_t start = 0;
  for (std::size_t first = 0; loop.size() > 3 && first < std::min(loop.size(), most_tried); ++first) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 2; k < loop.size() && least > best; ++k)
      least = std::min(least, twice_area(points, loop[first], loop[(first + k - 1) % loop.size()],
                                         loop[(first + k) % loop.size()]));
    if (least <= best) continue;
    best = least;
    start = first;
  }
  std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(start), loop.end());
  return loop;
}

}  // namespace

std::vector<std::uint32_t> triangles_of(const std::string& path, const std::vector<double>& points,
                                        std::vector<std::uint32_t> loop) {
  const std::vector<std::uint32_t> turned = best_start(points, std::move(loop));
  std::vector<std::uint32_t> triangles;
  if (!append_triangles(points, turned, triangles))
    throw Error(ErrorCode::write_failed, path + ": a wall is a concave polygon of " +
                                             std::to_string(turned.size()) +
                                             " corners, too many to be cut into triangles; write .vtu");
  return triangles;
}

std::vector<std::uint32_t> triangles_of(const std::string& path, const SharedCells& cells, std::uint64_t f) {
  const std::uint64_t one = std::min(f, cells.twin[f]);
  const auto corners = cells.face(one);
  std::vector<std::uint32_t> triangles = triangles_of(path, cells.points, {corners.begin(), corners.end()});
  if (one != f)
    for (std::size_t t = 0; t < triangles.size(); t += 3) std::swap(triangles[t + 1], triangles[t + 2]);
  return triangles;
}

}  // namespace powercell::io
