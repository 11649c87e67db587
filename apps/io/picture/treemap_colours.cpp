// Colours of treemaps, in OKLCH.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <string_view>

#include "apps/io/picture/colour_spaces.hpp"
#include "apps/io/picture/colouring.hpp"
#include "apps/io/picture/treemap_scene.hpp"
#include "apps/io/printable.hpp"
#include "apps/io/read/text.hpp"

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

// The fields of the colour column; where they are empty, those of the nearest group that has one.
std::vector<std::string_view> inherited_colours(const NamedTree& tree) {
  const std::size_t n = tree.size();
  std::vector<std::string_view> colours(n);
  std::vector<char> known(n, 0);
  std::vector<std::size_t> path;
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t at = i;
    for (path.clear(); known[at] == 0; at = static_cast<std::size_t>(tree.parent[at])) {
      path.push_back(at);
      if (!tree.colour[at].empty() || tree.parent[at] < 0) break;
    }
    const std::string_view found = known[at] != 0 ? colours[at] : std::string_view(tree.colour[at]);
    for (const std::size_t below : path) {
      colours[below] = found;
      known[below] = 1;
    }
  }
  return colours;
}

// Reads the texts as numbers, not a number where they are empty; false if one is none.
bool are_numbers(std::span<const std::string_view> texts, std::vector<double>& numbers) {
  numbers.assign(texts.size(), std::numeric_limits<double>::quiet_NaN());
  bool any = false;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (texts[i].empty()) continue;
    if (parse_number(texts[i], numbers[i]) != Parsed::ok) return false;
    any = true;
  }
  return any;
}

bool are_whole(std::span<const double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(),
                     [](double x) { return std::isnan(x) || (x == std::floor(x) && std::abs(x) < 1e15); });
}

}  // namespace

void check_tree_colours(const NamedTree& tree) {
  if (tree.colour.empty()) return;
  const std::vector<std::string_view> texts = inherited_colours(tree);
  std::vector<double> numbers;
  if (!are_numbers(texts, numbers)) check_classes(texts, tree.colour_column);
}

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
    const std::uint32_t hash = hash_of(output.tree.id[i]);
    if (const std::int64_t shade = output.shade[i]; shade >= 0) {
      const double step = static_cast<double>(shade % group_shades) - (group_shades - 1) / 2.0;
      lch[i] = {above.lightness + 0.042 * step, above.chroma + 0.02 * jitter(hash, 2),
                above.hue + (shade % 2 == 0 ? -0.018 : 0.018)};
      continue;
    }
    const double room = map.depth[i] == 2 ? 1 : 0.3;
    lch[i] = {std::clamp(above.lightness + 0.11 * room * jitter(hash, 1), 0.60, 0.92),
              std::clamp(above.chroma + 0.05 * room * jitter(hash, 2), 0.05, 0.14),
              above.hue + 0.045 * room * jitter(hash, 3)};
  }
  std::vector<Colour> colours(n);
  std::transform(lch.begin(), lch.end(), colours.begin(), [](const Lch& c) { return to_colour(c); });
  return colours;
}

Colouring treemap_colouring(const TreemapOutput& output, bool legend) {
  const NamedTree& tree = output.tree;
  const std::size_t n = tree.size();
  if (tree.colour.empty()) return {treemap_colours(output), {}, {}};
  std::vector<char> shown(n);
  for (std::size_t i = 0; i < n; ++i) shown[i] = output.map.kind[i] == TreeNode::leaf ? 1 : 0;
  const std::vector<std::string_view> texts = inherited_colours(tree);
  std::vector<double> numbers;
  Colouring colouring = are_numbers(texts, numbers) ? colours_of_numbers(numbers, shown, are_whole(numbers))
                                                    : colours_of_texts(texts, shown);
  colouring.legend.title = printable(tree.colour_column);
  if (!legend) colouring.legend = {};
  return colouring;
}

}  // namespace powercell::io
