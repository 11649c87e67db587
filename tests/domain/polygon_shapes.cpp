#include "tests/domain/polygon_shapes.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "lib/base/text.hpp"

namespace powercell::test {
namespace {

using Corner = std::array<double, 2>;

int below(Random& random, int count) {
  return static_cast<int>(random() % static_cast<std::uint64_t>(count));
}

Corner any_point(Random& random, int side) {
  return {double(below(random, side)), double(below(random, side))};
}

Ring any_ring(Random& random, int corners, int side) {
  Ring ring(static_cast<std::size_t>(corners));
  for (Corner& point : ring) point = any_point(random, side);
  return ring;
}

/// A triangle that is not flat.
Ring any_triangle(Random& random, int side) {
  while (true) {
    const Ring ring = any_ring(random, 3, side);
    const auto& [a, b, c] = std::array{ring[0], ring[1], ring[2]};
    if ((b[0] - a[0]) * (c[1] - a[1]) != (b[1] - a[1]) * (c[0] - a[0])) return ring;
  }
}

Ring rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

Ring any_rectangle(Random& random, int side) {
  const Corner at = any_point(random, side);
  return rectangle(at[0], at[1], at[0] + 1 + below(random, 3), at[1] + 1 + below(random, 3));
}

Ring diamond(double x, double y) {
  return {{x - 1, y}, {x, y - 1}, {x + 1, y}, {x, y + 1}};
}

/// A large square with small holes of any place.
PolygonPart with_triangles(Random& random) {
  const int side = 5 + below(random, 4);
  PolygonPart part{rectangle(0, 0, side, side), {}};
  if (below(random, 4) == 0)
    part.holes = {{{1, 1}, {side - 1.0, 2}, {2, side - 1.0}}, {{2, 2}, {3, 2}, {2, 3}}};
  if (below(random, 2) == 0) std::ranges::reverse(part.holes);
  for (int h = 1 + below(random, 4); h > 0; --h) {
    const Corner at = any_point(random, side);
    part.holes.push_back(any_triangle(random, 3));
    for (Corner& point : part.holes.back()) point = {at[0] + point[0], at[1] + point[1]};
    if (below(random, 20) == 0) part.holes.push_back(part.holes[0]);
  }
  return part;
}

/// Diamonds that touch at their corners, in a square that some of them touch too.
PolygonPart with_diamonds(Random& random) {
  const double margin = below(random, 2);
  PolygonPart part{rectangle(-margin, -margin, 6 + margin, 6 + margin), {}};
  for (int x = 1; x < 6; x += 2)
    for (int y = 1; y < 6; y += 2)
      if (below(random, 5) < 3) part.holes.push_back(diamond(x, y));
  std::ranges::shuffle(part.holes, random);
  if (below(random, 4) == 0) part.holes.push_back(any_rectangle(random, 6));
  return part;
}

/// The boundary of random unit squares: loops with the squares on their left. Where two squares touch at a
/// corner alone, the loops turn to one side throughout.
Polygon traced(Random& random) {
  std::array<std::array<bool, 7>, 7> taken{};
  for (int x = 1; x < 6; ++x)
    for (int y = 1; y < 6; ++y) taken[x][y] = below(random, 10) < 7;
  std::multimap<Corner, Corner> next;
  for (int x = 1; x < 6; ++x)
    for (int y = 1; y < 6; ++y) {
      if (!taken[x][y]) continue;
      const double l = x, b = y, r = x + 1, t = y + 1;
      if (!taken[x][y - 1]) next.insert({{l, b}, {r, b}});
      if (!taken[x + 1][y]) next.insert({{r, b}, {r, t}});
      if (!taken[x][y + 1]) next.insert({{r, t}, {l, t}});
      if (!taken[x - 1][y]) next.insert({{l, t}, {l, b}});
    }
  const double side = below(random, 2) ? 1 : -1;
  Polygon polygon;
  std::vector<Ring> holes;
  while (!next.empty()) {
    Ring ring;
    Corner at = next.begin()->first, from = at;
    double area = 0;
    do {
      auto [step, end] = next.equal_range(at);
      const auto turn = [&](const Corner& to) {
        return side * ((at[0] - from[0]) * (to[1] - at[1]) - (at[1] - from[1]) * (to[0] - at[0]));
      };
      if (std::next(step) != end && turn(std::next(step)->second) > turn(step->second)) ++step;
      ring.push_back(at);
      from = at;
      at = step->second;
      area += from[0] * at[1] - from[1] * at[0];
      next.erase(step);
    } while (at != ring[0]);
    if (area > 0)
      polygon.push_back({ring, {}});
    else
      holes.push_back(ring);
  }
  if (polygon.empty()) return {{rectangle(0, 0, 1, 1), {}}};
  for (const Ring& hole : holes)
    polygon[static_cast<std::size_t>(below(random, static_cast<int>(polygon.size())))].holes.push_back(hole);
  return polygon;
}

Polygon several_parts(Random& random) {
  const int side = 4 + below(random, 4);
  Polygon polygon;
  for (int p = 2 + below(random, 2); p > 0; --p) polygon.push_back({any_triangle(random, side), {}});
  if (below(random, 3) == 0) polygon.push_back({any_ring(random, 4, side), {}});
  return polygon;
}

Polygon rectangles(Random& random) {
  Polygon polygon;
  for (int p = 1 + below(random, 4); p > 0; --p) {
    polygon.push_back({any_rectangle(random, 7), {}});
    if (below(random, 3) == 0) polygon.back().holes.push_back(any_rectangle(random, 7));
  }
  return polygon;
}

/// A square with a hole, and parts inside the hole or not.
Polygon islands(Random& random) {
  Polygon polygon{{rectangle(0, 0, 7, 7), {rectangle(1, 1, 6, 6)}}};
  if (below(random, 2)) polygon[0].holes[0] = {{1, 1}, {6, 2}, {5, 6}, {2, 5}};
  for (int p = 1 + below(random, 3); p > 0; --p) {
    PolygonPart part{below(random, 2) ? any_triangle(random, 4) : any_rectangle(random, 4), {}};
    const double x = below(random, 4), y = below(random, 4);
    for (Corner& point : part.outer) point = {point[0] + x, point[1] + y};
    if (below(random, 6) == 0) part.holes.push_back(any_triangle(random, 8));
    polygon.push_back(part);
  }
  if (below(random, 4) == 0) polygon.push_back({polygon[0].holes[0], {}});
  std::ranges::shuffle(polygon, random);
  return polygon;
}

/// Rows of parts that touch along edges whose corners differ; sometimes a corner is moved.
Polygon rows(Random& random) {
  Polygon polygon;
  for (int y = 0; y < 3; ++y) {
    double x = below(random, 2), top = x;
    while (x < 6) {
      const double next = x + 1 + below(random, 3), next_top = next + below(random, 2);
      polygon.push_back({{{x, double(y)}, {next, double(y)}, {next_top, y + 1.0}, {top, y + 1.0}}, {}});
      x = next;
      top = next_top;
    }
  }
  if (below(random, 2)) {
    Ring& ring = polygon[static_cast<std::size_t>(below(random, static_cast<int>(polygon.size())))].outer;
    ring[static_cast<std::size_t>(below(random, 4))][static_cast<std::size_t>(below(random, 2))] += 1;
  }
  if (below(random, 4) == 0) polygon.push_back(polygon[0]);
  return polygon;
}

}  // namespace

Polygon random_polygon(int family, Random& random) {
  switch (family) {
    case 0:
      return {{any_ring(random, 3 + below(random, 6), 3 + below(random, 4)), {}}};
    case 1:
      return {with_triangles(random)};
    case 2:
      return {with_diamonds(random)};
    case 3:
      return traced(random);
    case 4:
      return several_parts(random);
    case 5:
      return rectangles(random);
    case 6:
      return islands(random);
    default:
      return rows(random);
  }
}

std::string text_of(const Polygon& polygon) {
  std::string text;
  const auto add = [&](const Ring& ring, const char* name) {
    text += name;
    for (const Corner& point : ring) text += " " + digits(point[0]) + "," + digits(point[1]);
    text += '\n';
  };
  for (const PolygonPart& part : polygon) {
    add(part.outer, "part");
    for (const Ring& hole : part.holes) add(hole, "  hole");
  }
  return text;
}

}  // namespace powercell::test
