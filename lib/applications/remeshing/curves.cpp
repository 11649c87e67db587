#include "lib/applications/remeshing/curves.hpp"

#include <algorithm>
#include <numbers>

namespace powercell::remeshing {
namespace {

struct KeptEdge {
  std::uint32_t a, b, triangle;
};

/// The graph of kept edges.
struct Net {
  std::vector<KeptEdge> edge;
  std::vector<std::vector<std::uint32_t>> at;  ///< per vertex: its edges
  std::vector<bool> corner;

  std::uint32_t other(std::uint32_t e, std::uint32_t v) const {
    return edge[e].a == v ? edge[e].b : edge[e].a;
  }
};

Net net_of(const Surface& surface, double sharp_angle) {
  Net net;
  net.at.resize(surface.vertex.size());
  for (std::uint32_t t = 0; t < surface.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t behind = surface.across[t][k];
      if (!surface.kept[t][k] || (behind != nothing && behind < t)) continue;
      const std::uint32_t a = surface.triangle[t][k], b = surface.triangle[t][(k + 1) % 3];
      net.at[a].push_back(static_cast<std::uint32_t>(net.edge.size()));
      net.at[b].push_back(static_cast<std::uint32_t>(net.edge.size()));
      net.edge.push_back({a, b, t});
    }
  const double straight = std::cos(sharp_angle * std::numbers::pi / 180);
  net.corner.assign(surface.vertex.size(), false);
  for (std::uint32_t v = 0; v < net.at.size(); ++v) {
    const auto& edges = net.at[v];
    if (edges.empty()) continue;
    net.corner[v] = edges.size() != 2;
    if (edges.size() != 2) continue;
    const Vec in = unit(surface.vertex[v] - surface.vertex[net.other(edges[0], v)]);
    const Vec out = unit(surface.vertex[net.other(edges[1], v)] - surface.vertex[v]);
    net.corner[v] = dot(in, out) < straight;
  }
  return net;
}

/// Follows unused edges from a vertex to the next corner or back to the start.
Curve walk(const Surface& surface, const Net& net, std::uint32_t start, std::uint32_t e,
           std::vector<bool>& used) {
  Curve curve;
  curve.vertex = {start};
  curve.along = {0};
  for (std::uint32_t v = start;;) {
    used[e] = true;
    const std::uint32_t u = net.other(e, v);
    curve.vertex.push_back(u);
    curve.triangle.push_back(net.edge[e].triangle);
    curve.along.push_back(curve.along.back() + norm(surface.vertex[u] - surface.vertex[v]));
    v = u;
    if (net.corner[v]) return curve;
    e = net.at[v][0] == e ? net.at[v][1] : net.at[v][0];
    if (used[e]) break;
  }
  curve.closed = true;
  return curve;
}

}  // namespace

Place Curve::at(const Surface& surface, double s) const {
  const auto after = std::upper_bound(along.begin() + 1, along.end() - 1, s);
  const auto k = static_cast<std::size_t>(after - along.begin()) - 1;
  const double step = along[k + 1] - along[k];
  const double share = step > 0 ? std::clamp((s - along[k]) / step, 0.0, 1.0) : 0;
  const Vec a = surface.vertex[vertex[k]], b = surface.vertex[vertex[k + 1]];
  // Exact at the ends, as corners must not move.
  return {triangle[k], share == 0 ? a : share == 1 ? b : a + (b - a) * share};
}

std::vector<Curve> kept_curves(const Surface& surface, double sharp_angle) {
  const Net net = net_of(surface, sharp_angle);
  std::vector<bool> used(net.edge.size(), false);
  std::vector<Curve> curves;
  for (std::uint32_t v = 0; v < net.at.size(); ++v) {
    if (!net.corner[v]) continue;
    for (const std::uint32_t e : net.at[v])
      if (!used[e]) curves.push_back(walk(surface, net, v, e, used));
  }
  for (std::uint32_t e = 0; e < net.edge.size(); ++e)
    if (!used[e]) curves.push_back(walk(surface, net, net.edge[e].a, e, used));
  return curves;
}

std::vector<double> seeds_along(const Sizing& sizing, const Curve& curve, std::size_t least_edges) {
  // The integral of 1/h up to each vertex, by the trapezoidal rule.
  std::vector<double> steps = {0};
  for (std::size_t k = 0; k + 1 < curve.vertex.size(); ++k) {
    const double h = (sizing.h[curve.vertex[k]] + sizing.h[curve.vertex[k + 1]]) / 2;
    steps.push_back(steps.back() + (curve.along[k + 1] - curve.along[k]) / h);
  }
  const std::size_t least = curve.closed ? std::max<std::size_t>(3, least_edges) : least_edges;
  const auto count = std::max(least, static_cast<std::size_t>(std::lround(steps.back())));
  std::vector<double> seeds;
  std::size_t k = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double wanted = steps.back() * static_cast<double>(i) / static_cast<double>(count);
    while (k + 2 < steps.size() && steps[k + 1] <= wanted) ++k;
    const double share = (wanted - steps[k]) / (steps[k + 1] - steps[k]);
    seeds.push_back(curve.along[k] + share * (curve.along[k + 1] - curve.along[k]));
  }
  if (!curve.closed) seeds.push_back(curve.length());
  return seeds;
}

}  // namespace powercell::remeshing
