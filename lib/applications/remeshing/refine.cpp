#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "lib/applications/remeshing/mesh_check.hpp"
#include "lib/applications/remeshing/surface.hpp"

namespace powercell::remeshing {
namespace {

std::uint64_t undirected_key(std::uint32_t a, std::uint32_t b) {
  return edge_key(std::min(a, b), std::max(a, b));
}

/// Cuts a triangle at the new vertices in the middle of its edges, `nothing` where an edge is not cut.
void cut(const Surface& surface, const std::array<std::uint32_t, 3>& row,
         const std::array<std::uint32_t, 3>& middle, std::vector<std::array<std::uint32_t, 3>>& out) {
  const auto count = 3 - std::count(middle.begin(), middle.end(), nothing);
  std::size_t k = 0;  // rotation of the triangle that leaves only the cases below
  if (count == 1)
    while (middle[k] == nothing) ++k;
  if (count == 2)
    while (middle[(k + 2) % 3] != nothing) ++k;
  const std::uint32_t a = row[k], b = row[(k + 1) % 3], c = row[(k + 2) % 3];
  const std::uint32_t ab = middle[k], bc = middle[(k + 1) % 3], ca = middle[(k + 2) % 3];
  if (count == 0) {
    out.push_back({a, b, c});
  } else if (count == 1) {
    out.insert(out.end(), {{a, ab, c}, {ab, b, c}});
  } else if (count == 2) {
    out.push_back({ab, b, bc});
    const auto length2 = [&](std::uint32_t u, std::uint32_t v) {
      return norm2(surface.vertex[u] - surface.vertex[v]);
    };
    if (length2(a, bc) < length2(ab, c))
      out.insert(out.end(), {{a, ab, bc}, {a, bc, c}});
    else
      out.insert(out.end(), {{a, ab, c}, {ab, bc, c}});
  } else {
    out.insert(out.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
}

}  // namespace

double refined_size(const Surface& surface, double longest) {
  const double power = std::log2(3.0);
  double triangles = 0;
  for (std::uint32_t t = 0; t < surface.size(); ++t) {
    double most = 0;
    for (int k = 0; k < 3; ++k)
      most = std::max(most, norm2(surface.corner(t, (k + 1) % 3) - surface.corner(t, k)));
    triangles += std::pow(std::max(1.0, std::sqrt(most) / longest), power);
  }
  return triangles;
}

Surface refined(const Surface& surface, double longest, std::vector<double>& value) {
  Surface result = surface;
  while (true) {
    std::unordered_map<std::uint64_t, std::uint32_t> middle;
    std::unordered_set<std::uint64_t> kept;
    for (std::uint32_t t = 0; t < result.size(); ++t)
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t a = result.triangle[t][k], b = result.triangle[t][(k + 1) % 3];
        const std::uint64_t key = undirected_key(a, b);
        if (result.kept[t][k]) kept.insert(key);
        if (norm2(result.vertex[a] - result.vertex[b]) <= longest * longest) continue;
        const auto [at, added] = middle.try_emplace(key, static_cast<std::uint32_t>(result.vertex.size()));
        if (!added) continue;
        result.vertex.push_back((result.vertex[a] + result.vertex[b]) * 0.5);
        value.push_back((value[a] + value[b]) / 2);
      }
    if (middle.empty()) return result;
    for (const auto& [key, at] : middle)
      if (kept.erase(key) > 0) {
        kept.insert(undirected_key(static_cast<std::uint32_t>(key >> 32), at));
        kept.insert(undirected_key(static_cast<std::uint32_t>(key), at));
      }
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const auto& row : result.triangle) {
      std::array<std::uint32_t, 3> middles{};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto at = middle.find(undirected_key(row[k], row[(k + 1) % 3]));
        middles[k] = at == middle.end() ? nothing : at->second;
      }
      cut(result, row, middles, triangles);
    }
    result.triangle = std::move(triangles);
    connect(result);
    result.kept.assign(result.size(), {false, false, false});
    for (std::uint32_t t = 0; t < result.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        result.kept[t][k] =
            kept.contains(undirected_key(result.triangle[t][k], result.triangle[t][(k + 1) % 3]));
  }
}

}  // namespace powercell::remeshing
