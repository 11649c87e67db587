// Labels of treemaps: the largest upright box of a text's proportions inside a convex cell, clear of its
// walls.
#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/io/picture/colour_spaces.hpp"
#include "apps/io/picture/text.hpp"
#include "apps/io/picture/treemap_scene.hpp"
#include "apps/io/printable.hpp"

namespace powercell::io {
namespace {

constexpr double label_height = 1.17;  // of an em, with accents and descenders
constexpr double filled = 0.86;        // of the largest box that fits

struct Box {
  double x = 0, y = 0, half_width = 0, half_height = 0;
  bool empty() const { return !(half_width > 0); }
};

// Where nx x + ny y >= offset; (nx, ny) is a unit vector.
struct HalfPlane {
  double nx, ny, offset;
};

// A convex part of the picture.
struct FreePart {
  std::vector<HalfPlane> sides;
  double low[2], high[2];  // contains it

  // The size s for which the box (x, y, s half_width, s half_height) touches a side; negative outside. It is
  // the minimum of affine functions of x and y and therefore concave.
  double size_at(double x, double y, double half_width, double half_height) const {
    double size = std::numeric_limits<double>::infinity();
    for (const HalfPlane& side : sides) {
      const double reach = std::fabs(side.nx) * half_width + std::fabs(side.ny) * half_height;
      size = std::min(size, (side.nx * x + side.ny * y - side.offset) / reach);
    }
    return size;
  }
};

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

// The largest box of these proportions, at most `most` times as large, by a golden section search in y over
// golden section searches in x.
Box largest_box(const FreePart& part, double half_width, double half_height, double most) {
  const auto size = [&](double x, double y) { return part.size_at(x, y, half_width, half_height); };
  const auto best_x = [&](double y) {
    return argmax(part.low[0], part.high[0], [&](double x) { return size(x, y); });
  };
  const double y = argmax(part.low[1], part.high[1], [&](double at) { return size(best_x(at), at); });
  const double x = best_x(y), s = std::clamp(size(x, y), 0.0, most);
  return {x, y, s * half_width, s * half_height};
}

bool overlap(const Box& a, const Box& b) {
  return std::fabs(a.x - b.x) < a.half_width + b.half_width &&
         std::fabs(a.y - b.y) < a.half_height + b.half_height;
}

// Moves the box above or below the boxes that it overlaps, whichever leaves more room; false if it keeps
// overlapping.
bool avoid(const std::vector<Box>& others, FreePart part, double half_width, double half_height, double most,
           Box& box) {
  const auto touched = [&] {
    return std::find_if(others.begin(), others.end(), [&](const Box& other) { return overlap(box, other); });
  };
  std::size_t moves = 0;
  for (auto other = touched(); other != others.end(); other = touched()) {
    if (++moves > others.size() || box.empty()) return false;
    FreePart upper = part, lower = std::move(part);
    upper.sides.push_back({0, -1, -(other->y - other->half_height)});
    lower.sides.push_back({0, 1, other->y + other->half_height});
    const Box a = largest_box(upper, half_width, half_height, most),
              b = largest_box(lower, half_width, half_height, most);
    const bool up = a.half_height > b.half_height;
    box = up ? a : b;
    part = up ? std::move(upper) : std::move(lower);
  }
  return true;
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
  Labels(TreemapScene& scene, const TreemapOutput& output, double scale)
      : scene_(scene), output_(output), scale_(scale) {}

  // Places the labels of groups from the top down, then those of leaves. A label that overlaps an earlier one
  // moves above or below it.
  void run() {
    std::vector<std::uint32_t> order;
    for (std::uint32_t k = 0; k < scene_.cells.size(); ++k)
      if (depth(k) > 0) order.push_back(k);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
    placed_.resize(scene_.cells.size());
    find_parents();
    find_parts();
    for (const std::uint32_t k : order) place(k);
    // The last label drawn is on top: groups over leaves.
    std::reverse(scene_.labels.begin(), scene_.labels.end());
  }

 private:
  std::uint32_t depth(std::uint32_t k) const { return output_.map.depth[scene_.cells[k].node]; }
  std::uint32_t rank(std::uint32_t k) const { return scene_.cells[k].leaf ? 1000000u : depth(k); }

  void find_parents() {
    parent_.assign(scene_.cells.size(), 0);
    std::vector<std::uint32_t> open;
    for (std::uint32_t k = 0; k < scene_.cells.size(); ++k) {
      while (!open.empty() && k > open.back() + scene_.below[open.back()]) open.pop_back();
      parent_[k] = open.empty() ? k : open.back();
      open.push_back(k);
    }
  }

  // The inside of each cell without the walls over it, each as wide as the widest of its level.
  void find_parts() {
    part_.resize(scene_.cells.size());
    for (std::uint32_t k = 0; k < scene_.cells.size(); ++k) add_sides(k);
  }

  void add_sides(std::uint32_t k) {
    const TreemapScene::Cell& cell = scene_.cells[k];
    FreePart& part = part_[k];
    double twice_area = 0;
    std::fill(std::begin(part.low), std::end(part.low), std::numeric_limits<double>::infinity());
    std::fill(std::begin(part.high), std::end(part.high), -std::numeric_limits<double>::infinity());
    for (std::uint64_t v = cell.first; v < cell.end; ++v) {
      const double *a = point(v), *b = point(v + 1 == cell.end ? cell.first : v + 1);
      twice_area += a[0] * b[1] - a[1] * b[0];
      for (int axis = 0; axis < 2; ++axis) {
        part.low[axis] = std::min(part.low[axis], a[axis]);
        part.high[axis] = std::max(part.high[axis], a[axis]);
      }
    }
    const double orientation = twice_area < 0 ? -1 : 1;
    for (std::uint64_t v = cell.first; v < cell.end; ++v) {
      const double *a = point(v), *b = point(v + 1 == cell.end ? cell.first : v + 1);
      const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
      if (!(length > 0)) continue;
      const double nx = -orientation * (b[1] - a[1]) / length, ny = orientation * (b[0] - a[0]) / length;
      const double offset = nx * a[0] + ny * a[1];
      part.sides.push_back({nx, ny, offset + widest_wall(depth(k), scale_) / 2});
    }
    const std::uint32_t above = parent_[k];
    if (above == k) return;
    // Walls of the groups around it, which may reach into the cell from a corner only.
    for (const HalfPlane& side : part_[above].sides) {
      bool reaches_in = false;
      for (std::uint64_t v = cell.first; v < cell.end; ++v)
        reaches_in = reaches_in || side.nx * point(v)[0] + side.ny * point(v)[1] < side.offset;
      if (reaches_in) part.sides.push_back(side);
    }
  }

  const double* point(std::uint64_t v) const { return &scene_.points[2 * v]; }

  // Only labels of ancestors can lie over a cell.
  std::vector<Box> over(std::uint32_t k) const {
    std::vector<Box> boxes;
    for (std::uint32_t at = k; parent_[at] != at;) {
      at = parent_[at];
      if (!placed_[at].empty()) boxes.push_back(placed_[at]);
    }
    return boxes;
  }

  void place(std::uint32_t k) {
    const TreemapScene::Cell& cell = scene_.cells[k];
    const std::uint32_t above = parent_[k];
    if (above != k && scene_.below[above] == scene_.below[k] + 1 && depth(k) > 1 && !placed_[above].empty()) {
      placed_[k] = placed_[above];  // the parent's label also stands for an only child
      return;
    }
    const Limits allowed = limits(depth(k), cell.leaf, scale_);
    const std::string text = printable(output_.tree.name[cell.node]);
    const bool bold = !cell.leaf;
    const double width = text_width(text, bold), halo = bold ? label_halo : 0;
    const double half_width = 0.5 * (width + halo), half_height = 0.5 * (label_height + halo);  // of an em
    const FreePart& part = part_[k];
    if (width <= 0 || part.sides.size() < 3 ||
        (part.high[0] - part.low[0]) * filled < 2 * allowed.least * half_width)
      return;
    const double most = allowed.most / filled;
    Box best = largest_box(part, half_width, half_height, most);
    if (!avoid(over(k), part, half_width, half_height, most, best)) return;
    const double size = filled * best.half_height / half_height;
    if (size < allowed.least) return;
    const bool dark = cell.leaf && to_lab(cell.fill).lightness < 0.58;
    scene_.labels.push_back({best.x, best.y, size, width * size, bold, dark,
                             depth(k) == 1 && bold ? 0.9 : (dark ? 1.0 : 0.85), text});
    placed_[k] = {best.x, best.y, half_width * size, half_height * size};
  }

  TreemapScene& scene_;
  const TreemapOutput& output_;
  double scale_;
  std::vector<Box> placed_;  // per cell: its label
  std::vector<std::uint32_t> parent_;
  std::vector<FreePart> part_;
};

}  // namespace

void add_treemap_labels(TreemapScene& scene, const TreemapOutput& output, double scale) {
  Labels(scene, output, scale).run();
}

}  // namespace powercell::io
