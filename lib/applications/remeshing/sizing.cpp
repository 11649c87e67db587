#include "lib/applications/remeshing/sizing.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>
#include <queue>

#include "lib/base/disjoint_sets.hpp"

namespace powercell::remeshing {
namespace {

/// For each vertex, whether it is on a kept edge.
std::vector<bool> on_kept_edge(const Surface& surface) {
  std::vector<bool> kept(surface.vertex.size(), false);
  for (std::uint32_t t = 0; t < surface.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (surface.kept[t][k]) kept[surface.triangle[t][k]] = kept[surface.triangle[t][(k + 1) % 3]] = true;
  return kept;
}

/// A third of the area of the triangles around each vertex.
std::vector<double> vertex_areas(const Surface& surface) {
  std::vector<double> area(surface.vertex.size(), 0);
  for (std::uint32_t t = 0; t < surface.size(); ++t)
    for (const std::uint32_t v : surface.triangle[t]) area[v] += surface.area(t) / 3;
  return area;
}

/// Mixed areas (Meyer, Desbrun, Schröder, Barr 2003): the part of the surface nearer to a vertex than to
/// others, except that obtuse triangles are divided into a half and two quarters.
std::vector<double> mixed_areas(const Surface& surface) {
  std::vector<double> area(surface.vertex.size(), 0);
  for (std::uint32_t t = 0; t < surface.size(); ++t) {
    const auto& row = surface.triangle[t];
    std::array<double, 3> cosine{}, length2{};  // at a corner; of the edge opposite to it
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec at = surface.vertex[row[k]], a = surface.vertex[row[(k + 1) % 3]],
                b = surface.vertex[row[(k + 2) % 3]];
      cosine[k] = dot(a - at, b - at);
      length2[k] = norm2(b - a);
    }
    const double whole = surface.area(t);
    const bool obtuse = cosine[0] < 0 || cosine[1] < 0 || cosine[2] < 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
      if (obtuse)
        area[row[k]] += cosine[k] < 0 ? whole / 2 : whole / 4;
      else  // cot = cosine / (2 area), an eighth of cot x squared length of each edge at the corner
        area[row[k]] += (cosine[u] * length2[u] + cosine[v] * length2[v]) / (16 * whole);
    }
  }
  return area;
}

/// Gives unknown vertices the mean of their known neighbours, and marks them as known.
/// \return whether there were any
bool spread(const Surface& surface, std::vector<double>& value, std::vector<bool>& known) {
  std::vector<double> sum(value.size(), 0), count(value.size(), 0);
  for (const auto& row : surface.triangle)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 1; c < 3; ++c) {
        const std::uint32_t v = row[k], u = row[(k + c) % 3];
        if (known[v] || !known[u]) continue;
        sum[v] += value[u];
        count[v] += 1;
      }
  bool any = false;
  for (std::size_t v = 0; v < value.size(); ++v) {
    if (count[v] == 0) continue;
    value[v] = sum[v] / count[v];
    known[v] = any = true;
  }
  return any;
}

/// One step of diffusion: the mean of a vertex and its neighbours, weighted by area.
void smooth(const Surface& surface, const std::vector<double>& area, std::vector<double>& value) {
  std::vector<double> sum(value.size()), weight = area;
  for (std::size_t v = 0; v < value.size(); ++v) sum[v] = area[v] * value[v];
  for (const auto& row : surface.triangle)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 1; c < 3; ++c) {
        const std::uint32_t u = row[(k + c) % 3];
        sum[row[k]] += area[u] * value[u] / 2;  // each neighbour is in two triangles
        weight[row[k]] += area[u] / 2;
      }
  for (std::size_t v = 0; v < value.size(); ++v)
    if (weight[v] > 0) value[v] = sum[v] / weight[v];
}

/// The values below which the shares `low` and `high` of the area lie.
std::pair<double, double> percentiles(const std::vector<double>& value, const std::vector<double>& area,
                                      double low, double high) {
  std::vector<std::size_t> order(value.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return value[a] < value[b]; });
  const double total = std::accumulate(area.begin(), area.end(), 0.0);
  double sum = 0, at_low = value[order.front()], at_high = value[order.back()];
  bool low_found = false;
  for (const std::size_t v : order) {
    sum += area[v];
    if (!low_found && sum >= low * total) {
      at_low = value[v];
      low_found = true;
    }
    if (sum >= high * total) {
      at_high = value[v];
      break;
    }
  }
  return {at_low, at_high};
}

double mean_edge(const Surface& surface) {
  double sum = 0;
  for (std::uint32_t t = 0; t < surface.size(); ++t)
    for (int k = 0; k < 3; ++k) sum += norm(surface.corner(t, (k + 1) % 3) - surface.corner(t, k));
  return sum / (3.0 * static_cast<double>(surface.size()));
}

/// Enforces h(v) <= h(u) + gradation |u - v| along edges, by Dijkstra's algorithm from the smallest values.
void limit_gradient(const Surface& surface, double gradation, std::vector<double>& h) {
  std::vector<std::uint32_t> offset(surface.vertex.size() + 1, 0), neighbor(6 * surface.size());
  for (const auto& row : surface.triangle)
    for (const std::uint32_t v : row) offset[v + 1] += 2;
  std::partial_sum(offset.begin(), offset.end(), offset.begin());
  std::vector<std::uint32_t> next(offset.begin(), offset.end() - 1);
  for (const auto& row : surface.triangle)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 1; c < 3; ++c) neighbor[next[row[k]]++] = row[(k + c) % 3];
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::uint32_t v = 0; v < h.size(); ++v) queue.emplace(h[v], v);
  while (!queue.empty()) {
    const auto [value, v] = queue.top();
    queue.pop();
    if (value > h[v]) continue;
    for (std::uint32_t e = offset[v]; e < offset[v + 1]; ++e) {
      const std::uint32_t u = neighbor[e];
      const double most = value + gradation * norm(surface.vertex[u] - surface.vertex[v]);
      if (h[u] <= most) continue;
      h[u] = most;
      queue.emplace(most, u);
    }
  }
}

/// Upper bounds of the sizing where the surface has several components: each gets about `enough` vertices at
/// least, (62), or fewer if these were more than a quarter of all.
std::vector<double> largest_sizing(const Surface& surface, std::size_t count) {
  constexpr double enough = 16;
  DisjointSets sets(surface.vertex.size());
  for (const auto& [a, b, c] : surface.triangle) {
    sets.unite(a, b);
    sets.unite(a, c);
  }
  std::vector<double> area(surface.vertex.size(), 0);  // at the root of each component
  for (std::uint32_t t = 0; t < surface.size(); ++t)
    area[sets.root(surface.triangle[t][0])] += surface.area(t);
  const auto components = std::count_if(area.begin(), area.end(), [](double a) { return a > 0; });
  const double vertices =
      std::min(enough, static_cast<double>(count) / (4 * static_cast<double>(components)));
  std::vector<double> most(surface.vertex.size(), std::numeric_limits<double>::infinity());
  if (components == 1 || vertices < 4) return most;
  for (std::uint32_t v = 0; v < most.size(); ++v)
    if (const double whole = area[sets.root(v)]; whole > 0)
      most[v] = std::sqrt(whole * 2 / (std::sqrt(3.0) * (vertices - 2)));
  return most;
}

}  // namespace

Curvature curvature(const Surface& surface) {
  std::vector<Vec> laplacian(surface.vertex.size());
  std::vector<double> defect(surface.vertex.size(), 2 * std::numbers::pi);
  for (const auto& row : surface.triangle)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = row[k], b = row[(k + 1) % 3], apex = row[(k + 2) % 3];
      const Vec u = surface.vertex[a] - surface.vertex[apex], v = surface.vertex[b] - surface.vertex[apex];
      const double sine = norm(cross(u, v)), cosine = dot(u, v);
      const Vec edge = surface.vertex[b] - surface.vertex[a];
      laplacian[a] += edge * (cosine / sine / 2);
      laplacian[b] += edge * (-cosine / sine / 2);
      defect[apex] -= std::atan2(sine, cosine);
    }
  const std::vector<double> area = mixed_areas(surface);
  Curvature result{std::vector<double>(area.size(), 0), std::vector<double>(area.size(), 0)};
  std::vector<bool> known = on_kept_edge(surface);
  known.flip();
  for (std::size_t v = 0; v < area.size(); ++v) {
    if (area[v] == 0) known[v] = false;
    if (!known[v]) continue;
    result.mean[v] = norm(laplacian[v]) / (2 * area[v]);
    const double gauss = defect[v] / area[v], mean = result.mean[v];
    result.largest[v] = mean + std::sqrt(std::max(0.0, mean * mean - gauss));
  }
  while (spread(surface, result.largest, known)) {
  }
  return result;
}

std::vector<double> relative_sizing(const Surface& surface, double reach, double contrast,
                                    Progress progress) {
  std::vector<double> value = curvature(surface).largest;
  const std::vector<double> area = vertex_areas(surface);
  // k steps of diffusion reach about sqrt(k) edges.
  const double edges = reach / mean_edge(surface);
  const int steps = static_cast<int>(std::clamp(edges * edges, 3.0, 60.0));
  for (int step = 0; step < steps; ++step) {
    progress.at(static_cast<double>(step) / steps);
    smooth(surface, area, value);
  }
  auto [low, high] = percentiles(value, area, 0.05, 0.95);
  low = std::max(low, high / (contrast * contrast));
  // Curvatures as small as rounding errors give a uniform sizing.
  const double flat = 1e-6 / std::sqrt(std::accumulate(area.begin(), area.end(), 0.0));
  for (double& v : value) v = high > flat ? 1 / std::sqrt(std::clamp(v, low, high)) : 1;
  const double least = *std::min_element(value.begin(), value.end());
  for (double& v : value) v /= least;
  return value;
}

double vertices_for(const Surface& surface, const std::vector<double>& h) {
  double triangles = 0, boundary = 0;
  for (std::uint32_t t = 0; t < surface.size(); ++t) {
    const auto& row = surface.triangle[t];
    const double mean = (h[row[0]] + h[row[1]] + h[row[2]]) / 3;
    triangles += surface.area(t) / (std::sqrt(3.0) / 4 * mean * mean);
    for (std::size_t k = 0; k < 3; ++k)
      if (surface.across[t][k] == nothing) {
        const std::uint32_t a = row[k], b = row[(k + 1) % 3];
        boundary += norm(surface.vertex[b] - surface.vertex[a]) / ((h[a] + h[b]) / 2);
      }
  }
  return triangles / 2 + boundary / 2 + surface.euler_characteristic();
}

double even_spacing(const Surface& surface, std::size_t count) {
  const double wanted = static_cast<double>(count);
  double kept = 0, boundary = 0;
  for (std::uint32_t t = 0; t < surface.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto edge = static_cast<std::size_t>(k);
      if (!surface.kept[t][edge]) continue;
      const double length = norm(surface.corner(t, (k + 1) % 3) - surface.corner(t, k));
      const bool at_boundary = surface.across[t][edge] == nothing;
      kept += at_boundary ? length : length / 2;  // inner edges are in two triangles
      boundary += at_boundary ? length : 0;
    }
  // Solves wanted h^2 = 2 area/sqrt(3) + boundary h/2.
  const double half = boundary / (4 * wanted);
  return std::max(half + std::sqrt(half * half + surface.area() / (wanted * std::sqrt(3.0) / 2)),
                  kept / wanted);
}

double Sizing::at(const Surface& surface, const Place& place) const {
  const std::uint32_t t = place.triangle;
  const auto share = barycentric(place.at, surface.corner(t, 0), surface.corner(t, 1), surface.corner(t, 2));
  const auto& row = surface.triangle[t];
  return share[0] * h[row[0]] + share[1] * h[row[1]] + share[2] * h[row[2]];
}

Sizing scaled_sizing(const Surface& surface, const std::vector<double>& shape, double gradation,
                     std::size_t count, Progress progress) {
  const double wanted = static_cast<double>(count);
  Sizing sizing{shape, gradation};
  const std::vector<double> most = largest_sizing(surface, count);
  double factor = even_spacing(surface, count), low = 0, high = 0;
  // Bracketed search: the number of vertices decreases with the factor, as its square without the limit.
  constexpr int most_steps = 40;
  constexpr double tolerance = 0.002;  // of the number of vertices
  for (int step = 0; step < most_steps; ++step) {
    progress.at(static_cast<double>(step) / most_steps);
    for (std::size_t v = 0; v < shape.size(); ++v) sizing.h[v] = std::min(factor * shape[v], most[v]);
    limit_gradient(surface, gradation, sizing.h);
    const double found = vertices_for(surface, sizing.h);
    if (std::fabs(found - wanted) <= tolerance * wanted) break;
    (found > wanted ? low : high) = factor;
    const double guess = factor * std::sqrt(std::max(found, 1.0) / wanted);
    factor = high == 0 || (guess > low && guess < high) ? guess : (low + high) / 2;
  }
  return sizing;
}

}  // namespace powercell::remeshing
