#include "apps/io/treemap_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/io/printable.hpp"

namespace powercell::io {
namespace {

constexpr double margin = 8;  // pixels

// Walls are wider at higher levels, and at most a fixed share of a small cell.
double wall_width(std::uint32_t depth, double area, double scale) {
  constexpr double widths[] = {5, 5, 2.6, 1.5, 0.9, 0.6, 0.45};
  const double width = widths[std::min<std::size_t>(depth, std::size(widths) - 1)];
  return std::min(width * scale, (depth <= 1 ? 0.09 : 0.045) * std::sqrt(area));
}

double area_of(const std::vector<double>& p, std::uint64_t first, std::uint64_t end) {
  double twice = 0;
  for (std::uint64_t v = first; v < end; ++v) {
    const std::uint64_t next = v + 1 == end ? first : v + 1;
    twice += p[2 * v] * p[2 * next + 1] - p[2 * v + 1] * p[2 * next];
  }
  return std::fabs(twice) / 2;
}

// Every node with a polygon, in preorder.
std::vector<std::uint32_t> preorder(const TreemapOutput& output, std::vector<std::uint32_t>& below) {
  const std::size_t n = output.tree.size();
  std::vector<std::vector<std::uint32_t>> children(n);
  std::vector<std::uint32_t> open, order;
  for (std::size_t i = 0; i < n; ++i) {
    if (output.map.kind[i] == TreeNode::dropped) continue;
    const std::int64_t parent = output.tree.parent[i];
    (parent < 0 ? open : children[static_cast<std::size_t>(parent)]).push_back(static_cast<std::uint32_t>(i));
  }
  std::vector<std::uint32_t> place(n);
  while (!open.empty()) {
    const std::uint32_t i = open.back();
    open.pop_back();
    place[i] = static_cast<std::uint32_t>(order.size());
    order.push_back(i);
    open.insert(open.end(), children[i].rbegin(), children[i].rend());
  }
  below.assign(order.size(), 0);
  for (std::size_t k = order.size(); k-- > 1;)
    below[place[static_cast<std::size_t>(output.tree.parent[order[k]])]] += below[k] + 1;
  return order;
}

}  // namespace

TreemapScene make_treemap_scene(const TreemapOutput& output, const TreemapStyle& style) {
  const Treemap& map = output.map;
  TreemapScene scene;
  const std::vector<std::uint32_t> order = preorder(output, scene.below);
  const std::uint32_t root = order.front();
  double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
  for (std::uint64_t v = map.vertex_offset[root]; v < map.vertex_offset[root + 1]; ++v)
    for (int k = 0; k < 2; ++k) {
      const double at = map.vertices[2 * v + static_cast<std::uint64_t>(k)];
      low[k] = std::min(low[k], at);
      high[k] = std::max(high[k], at);
    }
  const double scale = (style.long_side - 2 * margin) / std::max(high[0] - low[0], high[1] - low[1]);
  scene.width = std::ceil(scale * (high[0] - low[0]) + 2 * margin);
  scene.height = std::ceil(scale * (high[1] - low[1]) + 2 * margin);
  scene.title = printable(output.tree.name[root]);
  scene.description = fmt::format("{} leaves in {} nodes; worst area off by {:.2g} %", map.leaves,
                                  order.size(), 100 * map.worst_error);
  const std::vector<Colour> colours = treemap_colours(output);
  for (const std::uint32_t i : order) {
    TreemapScene::Cell cell{i, colours[i], 0, map.kind[i] == TreeNode::leaf, scene.points.size() / 2, 0};
    for (std::uint64_t v = map.vertex_offset[i]; v < map.vertex_offset[i + 1]; ++v) {
      scene.points.push_back(margin + scale * (map.vertices[2 * v] - low[0]));
      scene.points.push_back(margin + scale * (high[1] - map.vertices[2 * v + 1]));
    }
    cell.end = scene.points.size() / 2;
    cell.wall = wall_width(map.depth[i], area_of(scene.points, cell.first, cell.end), style.long_side / 1600);
    scene.cells.push_back(cell);
  }
  if (style.labels) add_treemap_labels(scene, output);
  return scene;
}

}  // namespace powercell::io
