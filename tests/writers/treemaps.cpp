// Pictures of treemaps: where labels and walls are, measured from the text as cairo draws it.
#include <cairo.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <powercell/shapes.hpp>
#include <powercell/treemap.hpp>
#include <random>
#include <set>

#include "apps/io/picture/colour_spaces.hpp"
#include "apps/io/picture/text.hpp"
#include "apps/io/picture/treemap_scene.hpp"

using namespace powercell;

namespace {

struct NamedLayout {
  io::NamedTree tree;
  Treemap map;
  std::vector<std::int64_t> hue, shade;
  io::TreemapOutput output() const { return {tree, map, hue, shade}; }
};

class Grower {
 public:
  explicit Grower(std::uint64_t seed) : random_(seed) { add(-1, 0, "root"); }

  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  std::size_t index(std::size_t n) { return static_cast<std::size_t>(uniform() * static_cast<double>(n)); }
  std::size_t size() const { return tree_.size(); }

  std::int64_t add(std::int64_t parent, double value, const std::string& name) {
    tree_.id.push_back("n" + std::to_string(tree_.size()));
    tree_.name.push_back(name);
    tree_.parent.push_back(parent);
    tree_.value.push_back(value);
    return static_cast<std::int64_t>(tree_.size()) - 1;
  }
  // Names of every length, with accents and descenders, each once.
  std::string name() {
    static constexpr const char* words[] = {"Åpgj", "il", "WWW", "quality", "É", "straße", "x"};
    std::string text = "n" + std::to_string(tree_.size());
    for (std::size_t k = index(4); k > 0; --k) text += std::string(" ") + words[index(std::size(words))];
    return text;
  }
  double value(double range) { return std::pow(range, uniform()); }

  NamedLayout lay_out(const Ring& outline) {
    NamedLayout made{std::move(tree_), {}, {}, {}};
    made.map = treemap({made.tree.parent, made.tree.value}, outline);
    made.hue = io::number_branches(made.map, {});
    made.shade = io::number_groups(made.map, made.tree.parent, {});
    return made;
  }

 private:
  std::mt19937_64 random_;
  io::NamedTree tree_;
};

const Ring page = {{0, 0}, {16, 0}, {16, 10}, {0, 10}};

NamedLayout wide_tree(std::size_t n) {
  Grower tree(3);
  for (std::size_t k = 0; k < n; ++k) tree.add(0, tree.value(1000), tree.name());
  return tree.lay_out(page);
}

// Each node below one of the last few.
NamedLayout random_tree(std::size_t n, std::size_t breadth, std::uint64_t seed, const Ring& outline) {
  Grower tree(seed);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t reach = std::min(breadth, tree.size());
    tree.add(static_cast<std::int64_t>(tree.size() - 1 - tree.index(reach)), tree.value(300), tree.name());
  }
  return tree.lay_out(outline);
}

// Groups of the second level with leaves, in several branches.
NamedLayout levels_tree(std::size_t branches, std::size_t groups, std::size_t leaves) {
  Grower tree(11);
  for (std::size_t b = 0; b < branches; ++b) {
    const std::int64_t branch = tree.add(0, 0, tree.name());
    for (std::size_t g = 0; g < groups; ++g) {
      const std::int64_t group = tree.add(branch, 0, tree.name());
      for (std::size_t k = 0; k < leaves; ++k) tree.add(group, tree.value(50), tree.name());
    }
  }
  return tree.lay_out(page);
}

std::vector<NamedLayout> several_trees() {
  std::vector<NamedLayout> all;
  all.push_back(wide_tree(250));
  all.push_back(random_tree(300, 3, 1, page));  // deep
  all.push_back(random_tree(400, 12, 2, disk(64)));
  all.push_back(random_tree(400, 60, 3, {{0, 0}, {3, 0}, {3, 9}, {0, 9}}));
  all.push_back(levels_tree(4, 6, 12));
  return all;
}

struct Box {
  double left, top, right, bottom;
};

// The ink of a label with its halo, as cairo draws it.
Box ink_of(const io::TreemapScene::Label& label) {
  cairo_surface_t* surface = cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, nullptr);
  cairo_t* to = cairo_create(surface);
  io::select_font(to, label.bold, label.size);
  io::add_text_path(to, label.text, label.x, label.y, 0.5);
  Box box{};
  if (label.bold) {
    cairo_set_line_width(to, 0.16 * label.size);
    cairo_set_line_join(to, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke_extents(to, &box.left, &box.top, &box.right, &box.bottom);
  } else {
    cairo_fill_extents(to, &box.left, &box.top, &box.right, &box.bottom);
  }
  cairo_destroy(to);
  cairo_surface_destroy(surface);
  return box;
}

// The distance of a box and a segment; 0 if they meet.
double distance(const Box& box, const double* a, const double* b) {
  constexpr double far = 10;  // pixels, beyond half of any wall
  if (std::min(a[0], b[0]) > box.right + far || std::max(a[0], b[0]) < box.left - far ||
      std::min(a[1], b[1]) > box.bottom + far || std::max(a[1], b[1]) < box.top - far)
    return far;
  double best = 1e300;
  constexpr int steps = 64;  // the segment as points; the corners of the box against the segment
  for (int k = 0; k <= steps; ++k) {
    const double x = a[0] + (b[0] - a[0]) * k / steps, y = a[1] + (b[1] - a[1]) * k / steps;
    best = std::min(best, std::hypot(std::max({box.left - x, 0.0, x - box.right}),
                                     std::max({box.top - y, 0.0, y - box.bottom})));
  }
  const double dx = b[0] - a[0], dy = b[1] - a[1], squared = dx * dx + dy * dy;
  for (const double x : {box.left, box.right})
    for (const double y : {box.top, box.bottom}) {
      const double t = squared > 0 ? std::clamp(((x - a[0]) * dx + (y - a[1]) * dy) / squared, 0.0, 1.0) : 0;
      best = std::min(best, std::hypot(a[0] + t * dx - x, a[1] + t * dy - y));
    }
  return best;
}

bool is_below(const io::NamedTree& tree, std::size_t node, std::size_t above) {
  for (std::int64_t at = tree.parent[node]; at >= 0; at = tree.parent[static_cast<std::size_t>(at)])
    if (static_cast<std::size_t>(at) == above) return true;
  return false;
}

}  // namespace

TEST_CASE("labels of treemaps touch neither each other nor the walls around them") {
  const std::vector<NamedLayout> trees = several_trees();
  for (std::size_t t = 0; t < trees.size(); ++t)
    for (const double size : {300.0, 1600.0}) {
      const NamedLayout& made = trees[t];
      const io::TreemapScene scene = io::make_treemap_scene(made.output(), {.long_side = size});
      CAPTURE(t);
      CAPTURE(size);
      if (size > 1000) CHECK(scene.labels.size() >= 20);  // few fit into the small one
      std::vector<Box> boxes;
      for (const auto& label : scene.labels) boxes.push_back(ink_of(label));
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const auto named = std::find(made.tree.name.begin(), made.tree.name.end(), scene.labels[i].text);
        REQUIRE(named != made.tree.name.end());
        const auto node = static_cast<std::size_t>(named - made.tree.name.begin());
        CAPTURE(scene.labels[i].text);
        for (std::size_t j = 0; j < i; ++j)
          CHECK((boxes[i].right < boxes[j].left || boxes[j].right < boxes[i].left ||
                 boxes[i].bottom < boxes[j].top || boxes[j].bottom < boxes[i].top));
        for (const io::TreemapScene::Cell& cell : scene.cells) {
          if (is_below(made.tree, cell.node, node)) continue;  // walls that a group's label may lie over
          double nearest = 1e300;
          for (std::uint64_t v = cell.first; v < cell.end; ++v)
            nearest =
                std::min(nearest, distance(boxes[i], &scene.points[2 * v],
                                           &scene.points[2 * (v + 1 == cell.end ? cell.first : v + 1)]));
          if (nearest < cell.wall / 2) {
            CAPTURE(made.tree.name[cell.node]);
            CHECK(nearest >= cell.wall / 2);
          }
        }
      }
    }
}

TEST_CASE("leaves on dark colours have light labels") {
  NamedLayout made = wide_tree(60);
  for (std::size_t i = 0; i < made.tree.size(); ++i) made.tree.colour.push_back(std::to_string(i));
  made.tree.colour_column = "rank";
  const io::TreemapScene scene = io::make_treemap_scene(made.output(), {});
  std::size_t light = 0;
  for (const auto& label : scene.labels) {
    const auto named = std::find(made.tree.name.begin(), made.tree.name.end(), label.text);
    const auto node = static_cast<std::size_t>(named - made.tree.name.begin());
    const auto cell =
        std::find_if(scene.cells.begin(), scene.cells.end(), [&](const auto& c) { return c.node == node; });
    const double fill = io::to_lab(cell->fill).lightness,
                 text = io::to_lab(label.light ? io::paper : io::ink).lightness;
    CHECK(std::abs(fill - text) > 0.25);
    light += label.light ? 1 : 0;
  }
  CHECK(light > 0);
  CHECK(light < scene.labels.size());
}

TEST_CASE("walls are wider the higher their level, each much more than the next") {
  const NamedLayout made = levels_tree(4, 6, 12);
  const io::TreemapScene scene = io::make_treemap_scene(made.output(), {});
  double narrowest[4] = {1e300, 1e300, 1e300, 1e300}, widest[4] = {};
  for (const auto& cell : scene.cells) {
    const std::uint32_t depth = made.map.depth[cell.node];
    narrowest[depth] = std::min(narrowest[depth], cell.wall);
    widest[depth] = std::max(widest[depth], cell.wall);
  }
  for (int depth = 1; depth < 3; ++depth) CHECK(narrowest[depth] > 1.5 * widest[depth + 1]);
}

TEST_CASE("groups of the second level with a common border differ in shade, with all their leaves") {
  for (const NamedLayout& made : {levels_tree(4, 6, 12), levels_tree(1, 40, 3), levels_tree(9, 3, 5)}) {
    const std::vector<io::Colour> colours = io::treemap_colours(made.output());
    std::size_t borders = 0;
    const auto corner = [&](std::size_t node, std::uint64_t v) {
      const std::uint64_t first = made.map.vertex_offset[node],
                          count = made.map.vertex_offset[node + 1] - first;
      return &made.map.vertices[2 * (first + v % count)];
    };
    const auto corners = [&](std::size_t node) {
      return made.map.vertex_offset[node + 1] - made.map.vertex_offset[node];
    };
    // The middle of a long edge of one lies on an edge of the other.
    const auto meet = [&](std::size_t a, std::size_t b) {
      for (std::uint64_t v = 0; v < corners(a); ++v) {
        const double *p = corner(a, v), *q = corner(a, v + 1);
        if (std::hypot(q[0] - p[0], q[1] - p[1]) < 0.05) continue;
        const double x = (p[0] + q[0]) / 2, y = (p[1] + q[1]) / 2;
        for (std::uint64_t w = 0; w < corners(b); ++w) {
          const double *r = corner(b, w), *s = corner(b, w + 1);
          const double ux = s[0] - r[0], uy = s[1] - r[1], length = std::hypot(ux, uy);
          const double along = ((x - r[0]) * ux + (y - r[1]) * uy) / length,
                       across = ((x - r[0]) * uy - (y - r[1]) * ux) / length;
          if (std::abs(across) < 1e-7 && along > 0 && along < length) return true;
        }
      }
      return false;
    };
    for (std::size_t a = 0; a < made.tree.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        if (made.map.depth[a] != 2 || made.map.depth[b] != 2 || made.tree.parent[a] != made.tree.parent[b])
          continue;
        if (!meet(a, b)) continue;
        ++borders;
        CHECK(made.shade[a] != made.shade[b]);
        // 2.3 in CIELAB, 0.02 here, is just noticeable.
        CHECK(io::distance(io::to_lab(colours[a]), io::to_lab(colours[b])) > 0.035);
      }
    CHECK(borders > 10);
    // A leaf is nearer to its own group than to the neighbours' shades.
    for (std::size_t i = 0; i < made.tree.size(); ++i)
      if (made.map.depth[i] == 3)
        CHECK(io::distance(io::to_lab(colours[i]),
                           io::to_lab(colours[static_cast<std::size_t>(made.tree.parent[i])])) < 0.03);
  }
}

TEST_CASE("groups keep their shades as long as neighbours differ") {
  const NamedLayout made = levels_tree(2, 8, 4);
  CHECK(io::number_groups(made.map, made.tree.parent, made.shade) == made.shade);
  // All shades were the same: most groups get others, and the largest of each branch keeps its own.
  const std::vector<std::int64_t> same(made.tree.size(), 3);
  const std::vector<std::int64_t> mended = io::number_groups(made.map, made.tree.parent, same);
  for (std::size_t branch = 0; branch < made.tree.size(); ++branch) {
    if (made.map.depth[branch] != 1) continue;
    std::size_t largest = 0;
    std::set<std::int64_t> shades;
    for (std::size_t i = 0; i < made.tree.size(); ++i) {
      if (made.tree.parent[i] != static_cast<std::int64_t>(branch)) continue;
      shades.insert(mended[i]);
      if (largest == 0 || made.map.value[i] > made.map.value[largest]) largest = i;
    }
    CHECK(mended[largest] == 3);
    CHECK(shades.size() > 2);
  }
}
