#include "apps/io/picture/treemap_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/io/picture/frame.hpp"
#include "apps/io/picture/periodic.hpp"
#include "apps/io/printable.hpp"

namespace powercell::io {
namespace {

constexpr double margin = 8;  // pixels

// Walls are at most a fixed share of a small cell.
double wall_width(std::uint32_t depth, double area, double scale) {
  constexpr double shares[] = {0.09, 0.09, 0.055, 0.03, 0.025};
  const double share = shares[std::min<std::size_t>(depth, std::size(shares) - 1)];
  return std::min(widest_wall(depth, scale), share * std::sqrt(area));
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

double widest_wall(std::uint32_t depth, double scale) {
  constexpr double widths[] = {5.5, 5.5, 3, 1.2, 0.8, 0.6, 0.45};
  return scale * widths[std::min<std::size_t>(depth, std::size(widths) - 1)];
}

TreemapScene make_treemap_scene(const TreemapOutput& output, const TreemapStyle& style) {
  const Treemap& map = output.map;
  TreemapScene scene;
  const std::vector<std::uint32_t> order = preorder(output, scene.below);
  const std::uint32_t root = order.front();
  FlatBox box;
  for (std::uint64_t v = map.vertex_offset[root]; v < map.vertex_offset[root + 1]; ++v)
    box.add(&map.vertices[2 * v]);
  const double wide = box.high[0] - box.low[0], tall = box.high[1] - box.low[1];
  const Colouring colouring = treemap_colouring(output, style.legend);
  PictureFrame frame({static_cast<int>(style.long_side), 0, false}, colouring.legend);
  const double scale =
      std::min((frame.room().width - 2 * margin) / wide, (frame.room().height - 2 * margin) / tall);
  frame.place(std::ceil(scale * wide + 2 * margin), std::ceil(scale * tall + 2 * margin));
  scene.width = frame.width();
  scene.height = frame.height();
  scene.legend = frame.legend();
  scene.stripes = stripe_distance(style.long_side);
  scene.title = printable(output.tree.name[root]);
  scene.description = fmt::format("{} leaves in {} nodes; worst area off by {:.2g} %", map.leaves,
                                  order.size(), 100 * map.worst_error);
  const double enlargement = frame.enlargement();
  for (const std::uint32_t i : order) {
    TreemapScene::Cell cell{i, colouring.colour[i],           colouring.is_striped(i),
                            0, map.kind[i] == TreeNode::leaf, scene.points.size() / 2,
                            0};
    for (std::uint64_t v = map.vertex_offset[i]; v < map.vertex_offset[i + 1]; ++v) {
      scene.points.push_back(frame.left() + margin + scale * (map.vertices[2 * v] - box.low[0]));
      scene.points.push_back(frame.top() + margin + scale * (box.high[1] - map.vertices[2 * v + 1]));
    }
    cell.end = scene.points.size() / 2;
    cell.wall = wall_width(map.depth[i], area_of(scene.points, cell.first, cell.end), enlargement);
    scene.cells.push_back(cell);
  }
  if (style.labels) add_treemap_labels(scene, output, enlargement);
  return scene;
}

}  // namespace powercell::io
