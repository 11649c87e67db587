#include "lib/applications/remeshing/surface.hpp"

#include <algorithm>
#include <numbers>
#include <powercell/error.hpp>
#include <string>
#include <utility>

#include "lib/base/text.hpp"

namespace powercell::remeshing {
namespace {

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorCode::invalid_domain, message);
}

/// An edge of a triangle, sorted by its vertices.
struct Side {
  std::uint32_t low, high, triangle, edge;
  friend auto operator<=>(const Side&, const Side&) = default;
};

std::vector<Side> sides_of(const Surface& surface) {
  std::vector<Side> sides;
  sides.reserve(3 * surface.size());
  for (std::uint32_t t = 0; t < surface.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(surface.triangle[t][k], surface.triangle[t][(k + 1) % 3]);
      sides.push_back({a, b, t, k});
    }
  std::sort(sides.begin(), sides.end());
  return sides;
}

Surface read(std::span<const double> given, std::span<const std::uint32_t> triangles, const Frame& frame) {
  Surface surface;
  surface.frame = frame;
  const std::vector<double> vertices = frame.to(given);
  for (std::size_t k = 0; k < vertices.size(); k += 3)
    surface.vertex.push_back({vertices[k], vertices[k + 1], vertices[k + 2]});
  for (std::size_t k = 0; k < triangles.size(); k += 3) {
    std::array<std::uint32_t, 3> row{};
    for (std::size_t c = 0; c < 3; ++c) row[c] = triangles[k + c];
    const Vec a = surface.vertex[row[0]], b = surface.vertex[row[1]], c = surface.vertex[row[2]];
    const double longest = std::max({norm2(b - a), norm2(c - b), norm2(a - c)});
    if (!(norm(normal_of(a, b, c)) > 1e-12 * longest))
      refuse("triangle " + std::to_string(k / 3) + " has no area, around " + surface.place_of(a));
    surface.triangle.push_back(row);
  }
  return surface;
}

std::string edge_name(std::uint32_t a, std::uint32_t b) {
  return "the edge between vertices " + std::to_string(a) + " and " + std::to_string(b);
}

bool has_directed(const std::array<std::uint32_t, 3>& row, std::uint32_t a, std::uint32_t b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (row[k] == a && row[(k + 1) % 3] == b) return true;
  return false;
}

/// Turns triangles so that neighbours have their common edge in opposite directions.
void orient(Surface& surface) {
  std::vector<bool> seen(surface.size(), false);
  std::vector<std::uint32_t> stack;
  for (std::uint32_t first = 0; first < surface.size(); ++first) {
    if (seen[first]) continue;
    seen[first] = true;
    stack.push_back(first);
    while (!stack.empty()) {
      const std::uint32_t t = stack.back();
      stack.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t next = surface.across[t][k];
        if (next == nothing) continue;
        const std::uint32_t a = surface.triangle[t][k], b = surface.triangle[t][(k + 1) % 3];
        const bool agrees = !has_directed(surface.triangle[next], a, b);
        if (!agrees && seen[next])
          refuse("the surface cannot be oriented: its orientation changes across " +
                 edge_name(std::min(a, b), std::max(a, b)) + ", around " +
                 surface.place_of(surface.vertex[a]));
        if (seen[next]) continue;
        if (!agrees) {
          std::swap(surface.triangle[next][1], surface.triangle[next][2]);
          std::swap(surface.across[next][0], surface.across[next][2]);
        }
        seen[next] = true;
        stack.push_back(next);
      }
    }
  }
}

/// Refuses a vertex whose triangles do not form one fan: sheets of the surface touch there.
void require_single_fans(const Surface& surface) {
  std::vector<std::uint32_t> count(surface.vertex.size(), 0), start(surface.vertex.size(), nothing);
  for (std::uint32_t t = 0; t < surface.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = surface.triangle[t][k];
      ++count[v];
      // A fan at the boundary is walked from its first triangle on.
      if (start[v] == nothing || surface.across[t][k] == nothing) start[v] = t;
    }
  for (std::uint32_t v = 0; v < surface.vertex.size(); ++v) {
    std::uint32_t walked = 0, t = start[v];
    while (t != nothing) {
      ++walked;
      std::size_t k = 0;
      while (surface.triangle[t][k] != v) ++k;
      t = surface.across[t][(k + 2) % 3];
      if (t == start[v]) break;
    }
    if (walked != count[v])
      refuse("the surface is not a manifold: sheets touch at vertex " + std::to_string(v) + ", around " +
             surface.place_of(surface.vertex[v]));
  }
}

void keep_sharp_edges(Surface& surface, double sharp_angle) {
  const double least_cosine = std::cos(sharp_angle * std::numbers::pi / 180);
  surface.kept.assign(surface.size(), {false, false, false});
  std::vector<Vec> normal(surface.size());
  for (std::uint32_t t = 0; t < surface.size(); ++t) normal[t] = surface.normal(t);
  for (std::uint32_t t = 0; t < surface.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t other = surface.across[t][k];
      surface.kept[t][k] = other == nothing || dot(normal[t], normal[other]) < least_cosine;
    }
}

}  // namespace

void connect(Surface& surface) {
  surface.across.assign(surface.size(), {nothing, nothing, nothing});
  const std::vector<Side> sides = sides_of(surface);
  for (std::size_t k = 0; k < sides.size();) {
    std::size_t end = k + 1;
    while (end < sides.size() && sides[end].low == sides[k].low && sides[end].high == sides[k].high) ++end;
    if (end - k > 2)
      refuse("the surface is not a manifold: " + edge_name(sides[k].low, sides[k].high) + " belongs to " +
             std::to_string(end - k) + " triangles, around " +
             surface.place_of(surface.vertex[sides[k].low]));
    if (end - k == 2) {
      surface.across[sides[k].triangle][sides[k].edge] = sides[k + 1].triangle;
      surface.across[sides[k + 1].triangle][sides[k + 1].edge] = sides[k].triangle;
    }
    k = end;
  }
}

std::string Surface::place_of(Vec x) const {
  const Vec at = frame.back(x);
  return place_text(&at.x);
}

int Surface::edge_towards(std::uint32_t t, std::uint32_t a, std::uint32_t b) const {
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t from = triangle[t][static_cast<std::size_t>(k)],
                        to = triangle[t][static_cast<std::size_t>((k + 1) % 3)];
    if (from == b && to == a) return k;
  }
  return -1;
}

double Surface::area() const {
  double sum = 0;
  for (std::uint32_t t = 0; t < size(); ++t) sum += area(t);
  return sum;
}

int Surface::euler_characteristic() const {
  std::vector<bool> used(vertex.size(), false);
  long twice_edges = 0;
  for (std::uint32_t t = 0; t < size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      used[triangle[t][k]] = true;
      twice_edges += across[t][k] == nothing ? 2 : 1;
    }
  const long vertices = std::count(used.begin(), used.end(), true);
  return static_cast<int>(vertices - twice_edges / 2 + static_cast<long>(size()));
}

int boundary_loops(const Surface& surface) {
  std::vector<std::uint32_t> next(surface.vertex.size(), nothing);
  for (std::uint32_t t = 0; t < surface.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (surface.across[t][k] == nothing) next[surface.triangle[t][k]] = surface.triangle[t][(k + 1) % 3];
  int loops = 0;
  for (std::uint32_t v = 0; v < next.size(); ++v) {
    if (next[v] == nothing) continue;
    ++loops;
    for (std::uint32_t u = v; next[u] != nothing;) u = std::exchange(next[u], nothing);
  }
  return loops;
}

Surface make_surface(std::span<const double> vertices, std::span<const std::uint32_t> triangles,
                     double sharp_angle, const Frame& frame) {
  Surface surface = read(vertices, triangles, frame);
  connect(surface);
  orient(surface);
  require_single_fans(surface);
  keep_sharp_edges(surface, sharp_angle);
  return surface;
}

}  // namespace powercell::remeshing
