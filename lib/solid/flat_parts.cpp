#include "lib/solid/flat_parts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <powercell/error.hpp>

#include "lib/domain/convex_pieces.hpp"
#include "lib/domain/orientation.hpp"

namespace powercell::solid {
namespace {

using Loop = std::vector<std::uint32_t>;
using Position = std::span<const std::array<double, 2>>;

/// Vertices nearer than this part of a loop's extent to the line between those around them are straight.
constexpr double straight = 0x1p-40;

void append(Polygons& out, std::span<const std::uint32_t> loop) {
  out.vertex.insert(out.vertex.end(), loop.begin(), loop.end());
  out.end.push_back(out.vertex.size());
}

double turn(const std::array<double, 2>& a, const std::array<double, 2>& b, const std::array<double, 2>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Loops without their straight vertices, which return when polygons are made of them.
class Straightened {
 public:
  Straightened(const Polygons& loops, Position position) : position_(position) {
    for (std::size_t k = 0; k < loops.end.size(); ++k) add(loops.loop(k));
  }

  /// Whether some loop is no more than an edge.
  bool flat() const { return flat_; }
  const std::vector<Loop>& loops() const { return loops_; }
  bool is_convex() const {
    if (loops_.size() != 1) return false;
    const Loop& loop = loops_[0];
    for (std::size_t k = 0, n = loop.size(); k < n; ++k)
      if (orient2d(position_[loop[k]].data(), position_[loop[(k + 1) % n]].data(),
                   position_[loop[(k + 2) % n]].data()) <= 0)
        return false;
    return true;
  }
  /// Appends a polygon of vertices that were kept, with the straight ones between them.
  void append_with_straight(std::span<const std::uint32_t> polygon, Polygons& out) const {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const std::uint32_t a = polygon[k], b = polygon[(k + 1) % polygon.size()];
      out.vertex.push_back(a);
      const auto between = between_.find({a, b});
      if (between != between_.end())
        out.vertex.insert(out.vertex.end(), between->second.begin(), between->second.end());
    }
    out.end.push_back(out.vertex.size());
  }

 private:
  void add(std::span<const std::uint32_t> loop) {
    const std::size_t n = loop.size();
    double extent = 0;
    std::size_t start = 0;  // a corner: the least point
    for (std::size_t k = 0; k < n; ++k) {
      const auto &a = position_[loop[0]], &b = position_[loop[k]];
      extent = std::max({extent, std::fabs(b[0] - a[0]), std::fabs(b[1] - a[1])});
      if (position_[loop[k]] < position_[loop[start]]) start = k;
    }
    Loop kept{loop[start]}, between;
    for (std::size_t k = 1; k <= n; ++k) {
      const std::uint32_t v = loop[(start + k) % n], after = loop[(start + k + 1) % n];
      const auto &a = position_[kept.back()], &c = position_[after];
      const double length = std::hypot(c[0] - a[0], c[1] - a[1]);
      const bool forward =
          (position_[v][0] - a[0]) * (c[0] - a[0]) + (position_[v][1] - a[1]) * (c[1] - a[1]) > 0;
      if (k < n && forward && std::fabs(turn(a, position_[v], c)) <= straight * extent * length) {
        between.push_back(v);
        continue;
      }
      if (!between.empty()) flat_ = !between_.emplace(std::pair(kept.back(), v), between).second || flat_;
      between.clear();
      if (k < n) kept.push_back(v);
    }
    flat_ = flat_ || kept.size() < 3;
    loops_.push_back(std::move(kept));
  }

  Position position_;
  std::vector<Loop> loops_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Loop> between_;
  bool flat_ = false;
};

/// Appends the parts by exact decisions.
/// \return false if that is not possible, and then nothing is appended
bool append_exact(const Straightened& from, Position position, Polygons& out) {
  std::vector<std::uint32_t> order;
  for (const Loop& loop : from.loops()) order.insert(order.end(), loop.begin(), loop.end());
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(position[a], a) < std::pair(position[b], b);
  });
  order.erase(std::unique(order.begin(), order.end()), order.end());
  IndexedRings rings;
  std::map<std::uint32_t, std::uint32_t> number;
  for (std::uint32_t k = 0; k < order.size(); ++k) {
    if (k > 0 && position[order[k]] == position[order[k - 1]]) return false;
    number[order[k]] = k;
    rings.vertices.insert(rings.vertices.end(), position[order[k]].begin(), position[order[k]].end());
  }
  for (const Loop& loop : from.loops()) {
    rings.rings.emplace_back();
    for (const std::uint32_t v : loop) rings.rings.back().vertex.push_back(number[v]);
  }
  Pieces pieces;
  try {
    append_convex_pieces(rings, rings.rings, pieces);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::invalid_domain) throw;
    return false;
  }
  Loop polygon;
  for (std::size_t p = 0; p + 1 < pieces.offset.size(); ++p) {
    polygon.clear();
    for (std::uint32_t k = pieces.offset[p]; k < pieces.offset[p + 1]; ++k)
      polygon.push_back(order[pieces.vertex[k]]);
    from.append_with_straight(polygon, out);
  }
  return true;
}

}  // namespace

void append_convex_parts(const Polygons& loops, Position position, Polygons& out) {
  if (loops.end.empty()) return;
  const Straightened straightened(loops, position);
  const bool thin_loop = straightened.flat() && loops.end.size() == 1;
  if (thin_loop || straightened.is_convex()) return append(out, loops.vertex);
  if (!straightened.flat() && append_exact(straightened, position, out)) return;
  for (std::size_t k = 0; k < loops.end.size(); ++k) {
    const std::span<const std::uint32_t> loop = loops.loop(k);
    for (std::size_t v = 2; v < loop.size(); ++v) append(out, std::array{loop[0], loop[v - 1], loop[v]});
  }
}

}  // namespace powercell::solid
