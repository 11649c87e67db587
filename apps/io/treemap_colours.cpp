// Colours of treemaps, in OKLCH.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <string_view>

#include "apps/io/colour_spaces.hpp"
#include "apps/io/treemap_scene.hpp"

namespace powercell::io {
namespace {

// FNV-1a. A node keeps its colour when other nodes come, go or change their order.
std::uint32_t hash_of(std::string_view id) {
  std::uint32_t hash = 2166136261u;
  for (const char c : id) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash;
}

// In [-0.5, 0.5].
double jitter(std::uint32_t hash, std::uint32_t salt) {
  std::uint32_t x = hash * 0x9e3779b9u + salt;
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return (x ^ (x >> 16)) / 4294967296.0 - 0.5;
}

}  // namespace

std::vector<std::int64_t> number_branches(const Treemap& map, std::span<const std::int64_t> earlier) {
  const std::size_t n = map.kind.size();
  std::vector<std::int64_t> number(n, -1);
  std::vector<std::size_t> fresh;
  std::set<std::int64_t> taken;
  for (std::size_t i = 0; i < n; ++i) {
    if (map.depth[i] != 1 || map.kind[i] == TreeNode::dropped) continue;
    if (!earlier.empty() && earlier[i] >= 0 && taken.insert(earlier[i]).second)
      number[i] = earlier[i];
    else
      fresh.push_back(i);
  }
  std::stable_sort(fresh.begin(), fresh.end(),
                   [&](std::size_t a, std::size_t b) { return map.value[a] > map.value[b]; });
  std::int64_t next = 0;
  for (const std::size_t i : fresh) {
    while (taken.contains(next)) ++next;
    number[i] = next++;
  }
  return number;
}

std::vector<Colour> treemap_colours(const TreemapOutput& output) {
  const Treemap& map = output.map;
  const std::size_t n = output.tree.size();
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return map.depth[a] < map.depth[b]; });
  std::vector<Lch> lch(n, {0.86, 0.03, 0.68});
  // Steps of the golden section give close numbers distant hues.
  for (std::size_t i = 0; i < n; ++i)
    if (const std::int64_t k = output.hue[i]; k >= 0)
      lch[i] = {0.80 - 0.05 * static_cast<double>(k % 3), 0.105,
                std::fmod(0.70 + 0.6180339887 * static_cast<double>(k), 1.0)};
  for (const std::uint32_t i : order) {
    if (map.depth[i] < 2) continue;
    const Lch& above = lch[static_cast<std::size_t>(output.tree.parent[i])];
    const double room = map.depth[i] == 2 ? 1 : 0.55;
    const std::uint32_t hash = hash_of(output.tree.id[i]);
    lch[i] = {std::clamp(above.lightness + 0.11 * room * jitter(hash, 1), 0.62, 0.92),
              std::clamp(above.chroma + 0.05 * room * jitter(hash, 2), 0.05, 0.14),
              above.hue + 0.045 * room * jitter(hash, 3)};
  }
  std::vector<Colour> colours(n);
  std::transform(lch.begin(), lch.end(), colours.begin(), [](const Lch& c) { return to_colour(c); });
  return colours;
}

}  // namespace powercell::io
