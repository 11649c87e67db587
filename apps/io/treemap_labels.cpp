// Labels of treemaps: the largest upright box of a text's proportions inside a convex cell.
#include <algorithm>
#include <cmath>
#include <span>

#include "apps/io/picture_text.hpp"
#include "apps/io/printable.hpp"
#include "apps/io/treemap_scene.hpp"

namespace powercell::io {
namespace {

using Polygon = std::vector<std::array<double, 2>>;

constexpr double line_height = 1.15;  // of an em
constexpr double filled = 0.86;       // of the largest box that fits

struct Box {
  double x = 0, y = 0, half_width = 0, half_height = 0;
};

// The size s for which the box (x, y, s half_width, s half_height) touches the polygon; negative outside. It
// is the minimum of affine functions of x and y and therefore concave.
double size_at(const Polygon& polygon, double orientation, double x, double y, double half_width,
               double half_height) {
  double size = 1e300;
  for (std::size_t v = 0; v < polygon.size(); ++v) {
    const auto &a = polygon[v], &b = polygon[v + 1 == polygon.size() ? 0 : v + 1];
    const double nx = -orientation * (b[1] - a[1]), ny = orientation * (b[0] - a[0]);  // inwards
    const double reach = std::fabs(nx) * half_width + std::fabs(ny) * half_height;
    if (reach > 0) size = std::min(size, (nx * (x - a[0]) + ny * (y - a[1])) / reach);
  }
  return size;
}

template <class Function>
double argmax(double low, double high, const Function& function) {
  constexpr double ratio = 0.6180339887498949;
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double at_a = function(a), at_b = function(b);
  for (int k = 0; k < 18; ++k) {
    if (at_a < at_b) {
      low = a;
      a = b;
      at_a = at_b;
      b = low + ratio * (high - low);
      at_b = function(b);
    } else {
      high = b;
      b = a;
      at_b = at_a;
      a = high - ratio * (high - low);
      at_a = function(a);
    }
  }
  return 0.5 * (low + high);
}

double signed_area(const Polygon& p) {
  double twice = 0;
  for (std::size_t v = 0; v < p.size(); ++v) {
    const auto &a = p[v], &b = p[v + 1 == p.size() ? 0 : v + 1];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice / 2;
}

// The largest box of these proportions, at most `most` times as large, by a golden section search in y over
// golden section searches in x.
Box largest_box(const Polygon& polygon, double half_width, double half_height, double most) {
  if (polygon.size() < 3) return {};
  double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
  for (const auto& p : polygon)
    for (int k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], p[static_cast<std::size_t>(k)]);
      high[k] = std::max(high[k], p[static_cast<std::size_t>(k)]);
    }
  const double orientation = signed_area(polygon) < 0 ? -1 : 1;
  const auto size = [&](double x, double y) {
    return size_at(polygon, orientation, x, y, half_width, half_height);
  };
  const auto best_x = [&](double y) { return argmax(low[0], high[0], [&](double x) { return size(x, y); }); };
  const double y = argmax(low[1], high[1], [&](double at) { return size(best_x(at), at); });
  const double x = best_x(y), s = std::min(std::max(size(x, y), 0.0), most);
  return {x, y, s * half_width, s * half_height};
}

// The part with y <= limit, or with y >= limit.
Polygon cut(const Polygon& polygon, double limit, bool above) {
  Polygon kept;
  const double sign = above ? 1 : -1;
  for (std::size_t v = 0; v < polygon.size(); ++v) {
    const auto &a = polygon[v], &b = polygon[v + 1 == polygon.size() ? 0 : v + 1];
    const double at_a = sign * (a[1] - limit), at_b = sign * (b[1] - limit);
    if (at_a <= 0) kept.push_back(a);
    if (at_a * at_b < 0) {
      const double t = at_a / (at_a - at_b);
      kept.push_back({a[0] + t * (b[0] - a[0]), limit});
    }
  }
  return kept;
}

bool overlap(const Box& a, const Box& b) {
  return std::fabs(a.x - b.x) < a.half_width + b.half_width &&
         std::fabs(a.y - b.y) < 0.999 * (a.half_height + b.half_height);
}

struct Limits {
  double least, most;  // sizes of the font, pixels
};
// `scale` is that of the picture: it raises the upper limits, not the least legible sizes.
Limits limits(std::uint32_t depth, bool leaf, double scale) {
  if (leaf) return {6.5, 26 * scale};
  if (depth == 1) return {9, 54 * scale};
  return {8.5, (depth == 2 ? 28 : 18) * scale};
}

class Labels {
 public:
  Labels(TreemapScene& scene, const TreemapOutput& output) : scene_(scene), output_(output) {}

  // Places the labels of groups from the top down, then those of leaves. A label that overlaps an earlier one
  // moves above or below it.
  void run() {
    std::vector<std::uint32_t> order;
    for (std::uint32_t k = 0; k < scene_.cells.size(); ++k)
      if (output_.map.depth[scene_.cells[k].node] > 0) order.push_back(k);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
    blockers_.resize(scene_.cells.size());
    find_parents();
    for (const std::uint32_t k : order) place(k);
    // The last label drawn is on top: groups over leaves.
    std::reverse(scene_.labels.begin(), scene_.labels.end());
  }

 private:
  std::uint32_t rank(std::uint32_t k) const {
    return scene_.cells[k].leaf ? 1000000u : output_.map.depth[scene_.cells[k].node];
  }

  void find_parents() {
    parent_.assign(scene_.cells.size(), 0);
    std::vector<std::uint32_t> open;
    for (std::uint32_t k = 0; k < scene_.cells.size(); ++k) {
      while (!open.empty() && k > open.back() + scene_.below[open.back()]) open.pop_back();
      parent_[k] = open.empty() ? k : open.back();
      open.push_back(k);
    }
  }

  // Only labels of ancestors can lie over a cell.
  std::vector<Box> over(std::uint32_t k) const {
    std::vector<Box> boxes;
    for (std::uint32_t at = k; parent_[at] != at;) {
      at = parent_[at];
      if (blockers_[at].half_width > 0) boxes.push_back(blockers_[at]);
    }
    return boxes;
  }

  // Moves the box above or below the boxes that it overlaps, whichever leaves more room; false if it keeps
  // overlapping.
  static bool avoid(const std::vector<Box>& others, Polygon polygon, double half_width, double half_height,
                    double most, Box& box) {
    const auto touched = [&] {
      return std::find_if(others.begin(), others.end(),
                          [&](const Box& other) { return overlap(box, other); });
    };
    std::size_t moves = 0;
    for (auto other = touched(); other != others.end(); other = touched()) {
      if (++moves > others.size()) return false;
      Polygon upper = cut(polygon, other->y - other->half_height, true);
      Polygon lower = cut(polygon, other->y + other->half_height, false);
      const Box a = largest_box(upper, half_width, half_height, most),
                b = largest_box(lower, half_width, half_height, most);
      const bool up = a.half_height > b.half_height;
      box = up ? a : b;
      polygon = up ? std::move(upper) : std::move(lower);
    }
    return true;
  }

  void place(std::uint32_t k) {
    const TreemapScene::Cell& cell = scene_.cells[k];
    const std::uint32_t depth = output_.map.depth[cell.node];
    if (parent_[k] != k && scene_.below[parent_[k]] == scene_.below[k] + 1 && depth > 1 &&
        blockers_[parent_[k]].half_width > 0) {
      blockers_[k] = blockers_[parent_[k]];  // the parent's label also stands for an only child
      return;
    }
    const Limits allowed = limits(depth, cell.leaf, std::max(scene_.width, scene_.height) / 1600);
    const std::string text = printable(output_.tree.name[cell.node]);
    const bool bold = !cell.leaf;
    const double half_width = 0.5 * text_width(text, bold), half_height = 0.5 * line_height;
    Polygon polygon;
    double low = 1e300, high = -1e300;
    for (std::uint64_t v = cell.first; v < cell.end; ++v) {
      polygon.push_back({scene_.points[2 * v], scene_.points[2 * v + 1]});
      low = std::min(low, polygon.back()[0]);
      high = std::max(high, polygon.back()[0]);
    }
    if (half_width <= 0 || (high - low) * filled < 2 * allowed.least * half_width) return;
    const double most = allowed.most / filled;
    Box best = largest_box(polygon, half_width, half_height, most);
    if (!avoid(over(k), polygon, half_width, half_height, most, best)) return;
    const double size = filled * best.half_height / half_height;
    if (size < allowed.least) return;
    scene_.labels.push_back(
        {best.x, best.y, size, 2 * half_width * size, bold, depth == 1 && bold ? 0.9 : 0.85, text});
    blockers_[k] = {best.x, best.y, half_width * size, half_height * size};
  }

  TreemapScene& scene_;
  const TreemapOutput& output_;
  std::vector<Box> blockers_;  // per cell: its label
  std::vector<std::uint32_t> parent_;
};

}  // namespace

void add_treemap_labels(TreemapScene& scene, const TreemapOutput& output) {
  Labels(scene, output).run();
}

}  // namespace powercell::io
