// Colours of treemaps, in Ottosson's OKLCH (2020), whose steps are perceptually uniform.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <string_view>

#include "apps/io/treemap_scene.hpp"

namespace powercell::io {
namespace {

struct Lch {
  double lightness, chroma, hue;  // hue in turns
};

Colour to_colour(const Lch& lch) {
  const double a = lch.chroma * std::cos(2 * std::numbers::pi * lch.hue);
  const double b = lch.chroma * std::sin(2 * std::numbers::pi * lch.hue);
  const double l = std::pow(lch.lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lch.lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lch.lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  return {to_srgb(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          to_srgb(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          to_srgb(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

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
  std::transform(lch.begin(), lch.end(), colours.begin(), to_colour);
  return colours;
}

}  // namespace powercell::io
