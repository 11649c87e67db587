#include "lib/domain/polygon_faults.hpp"

#include <algorithm>
#include <array>

namespace powercell {
namespace {

/// "its outer ring" or "its hole 2"
std::string name(const IndexedRing& ring) {
  return ring.hole == 0 ? std::string("its outer ring") : "its hole " + std::to_string(ring.hole - 1);
}

/// "part 3: WHAT; ..."
std::string of_part(std::uint32_t part, const std::string& what) {
  return "part " + std::to_string(part) + ": " + what +
         "; rings must not cross or touch themselves, and holes must lie inside their outer ring";
}

/// "parts 0 and 3 overlap WHERE; ..."
std::string of_parts(std::uint32_t p, std::uint32_t q, const std::string& where) {
  return "parts " + std::to_string(std::min(p, q)) + " and " + std::to_string(std::max(p, q)) + " overlap" +
         where + "; parts may touch but not overlap: unite them first";
}

/// Where two edges cross, rounded, and in both of their boxes.
std::array<double, 2> crossing_point(const std::array<const double*, 4>& end) {
  using Real = long double;
  const auto less = [&](int k, int from, int axis) {
    return static_cast<Real>(end[static_cast<std::size_t>(k)][axis]) -
           end[static_cast<std::size_t>(from)][axis];
  };
  const auto turn = [&](int a, int b, int c) {
    return less(b, a, 0) * less(c, a, 1) - less(b, a, 1) * less(c, a, 0);
  };
  const Real before = turn(2, 3, 0), behind = turn(2, 3, 1);
  const Real along = before == behind ? Real(0) : before / (before - behind);
  std::array<double, 2> x{};
  for (int k = 0; k < 2; ++k) {
    const auto [low, high] = std::minmax(end[0][k], end[1][k]);
    const auto [least, most] = std::minmax(end[2][k], end[3][k]);
    const auto value = static_cast<double>(end[0][k] + along * less(1, 0, k));
    x[static_cast<std::size_t>(k)] = std::clamp(std::clamp(value, low, high), least, most);
  }
  return x;
}

}  // namespace

std::string PolygonFaults::crossing_at(const RingEdge& e, const RingEdge& f, const std::string& where) const {
  if (part(e.ring) != part(f.ring))
    return of_parts(part(e.ring), part(f.ring), ": their edges cross at " + where);
  if (e.ring == f.ring)
    return of_part(part(e.ring), name(rings_.rings[e.ring]) + " crosses itself at " + where);
  const auto [first, second] = std::minmax(e.ring, f.ring);
  return of_part(part(first),
                 name(rings_.rings[first]) + " and " + name(rings_.rings[second]) + " cross at " + where);
}

std::string PolygonFaults::crossing(const RingEdge& e, const RingEdge& f) const {
  const auto x =
      crossing_point({rings_.at(e.left), rings_.at(e.right), rings_.at(f.left), rings_.at(f.right)});
  return crossing_at(e, f, place(x[0], x[1]));
}

std::string PolygonFaults::crossing(const RingEdge& e, const RingEdge& f, std::uint32_t v) const {
  return crossing_at(e, f, at(v));
}

std::string PolygonFaults::common_edge(const RingEdge& e, const RingEdge& f, std::uint32_t v) const {
  const std::string where = " from " + at(v) + " to " + at(std::min(e.right, f.right));
  if (part(e.ring) != part(f.ring)) return of_parts(part(e.ring), part(f.ring), ", along their edge" + where);
  const auto [first, second] = std::minmax(e.ring, f.ring);
  if (first == second) return of_part(part(first), name(rings_.rings[first]) + " runs along itself" + where);
  return of_part(part(first), name(rings_.rings[first]) + " and " + name(rings_.rings[second]) +
                                  " have an edge in common," + where);
}

std::string PolygonFaults::meets_itself(std::uint32_t ring, std::uint32_t v) const {
  return of_part(part(ring), name(rings_.rings[ring]) + " meets itself at " + at(v));
}

std::string PolygonFaults::cut_in_pieces(std::uint32_t part, std::uint32_t v) const {
  return "part " + std::to_string(part) + ": its rings touch, the last time at " + at(v) +
         ", so that they cut it in pieces; make each piece a part of its own";
}

std::optional<std::string> PolygonFaults::around(const std::map<std::uint32_t, int>& winding,
                                                 std::uint32_t v) const {
  std::optional<std::uint32_t> covers;  // the part that the place lies in
  for (auto ring = winding.begin(); ring != winding.end();) {
    const std::uint32_t p = part(ring->first);
    bool in_outer = false;
    std::vector<std::uint32_t> holes;
    for (; ring != winding.end() && part(ring->first) == p; ++ring) {
      if (ring->second == 0) continue;
      if (rings_.rings[ring->first].hole == 0)
        in_outer = true;
      else
        holes.push_back(ring->first);
    }
    if (!holes.empty() && !in_outer)
      return of_part(p, name(rings_.rings[holes[0]]) + " lies outside its outer ring, at " + at(v));
    if (holes.size() > 1)
      return of_part(p, name(rings_.rings[holes[0]]) + " and " + name(rings_.rings[holes[1]]) +
                            " are nested, at " + at(v));
    if (!in_outer || !holes.empty()) continue;
    if (covers) return of_parts(*covers, p, ", for instance at " + at(v));
    covers = p;
  }
  return std::nullopt;
}

}  // namespace powercell
