#include <cairo.h>

#include "apps/io/picture/cairo.hpp"
#include "apps/io/picture/text.hpp"
#include "apps/io/picture/treemap_scene.hpp"

namespace powercell::io {
namespace {

void add_outline(cairo_t* to, const TreemapScene& scene, const TreemapScene::Cell& cell) {
  cairo_new_path(to);
  for (std::uint64_t v = cell.first; v < cell.end; ++v)
    cairo_line_to(to, scene.points[2 * v], scene.points[2 * v + 1]);
  cairo_close_path(to);
}

void draw_label(cairo_t* to, const TreemapScene::Label& label) {
  select_font(to, label.bold, label.size);
  if (label.bold) {
    add_text_path(to, label.text, label.x, label.y, 0.5);
    set_colour(to, paper, halo_opacity);
    cairo_set_line_width(to, label_halo * label.size);
    cairo_stroke_preserve(to);
    set_colour(to, ink, label.opacity);
    cairo_fill(to);
  } else {
    set_colour(to, label.light ? paper : ink, label.opacity);
    show_text(to, label.text, label.x, label.y, 0.5);
  }
}

void draw(cairo_t* to, const TreemapScene& scene) {
  set_colour(to, paper);
  cairo_paint(to);
  cairo_set_line_join(to, CAIRO_LINE_JOIN_ROUND);
  std::vector<std::size_t> open;
  const auto wall = [&](const TreemapScene::Cell& cell) {
    add_outline(to, scene, cell);
    set_colour(to, paper);
    cairo_set_line_width(to, cell.wall);
    cairo_stroke(to);
  };
  const auto close_up_to = [&](std::size_t k) {
    for (; !open.empty() && k > open.back() + scene.below[open.back()]; open.pop_back())
      wall(scene.cells[open.back()]);
  };
  for (std::size_t k = 0; k < scene.cells.size(); ++k) {
    close_up_to(k);
    const TreemapScene::Cell& cell = scene.cells[k];
    if (!cell.leaf) {
      open.push_back(k);
      continue;
    }
    add_outline(to, scene, cell);
    if (cell.striped) {
      fill_striped(to, scene.stripes);
    } else {
      set_colour(to, cell.fill);
      cairo_fill(to);
    }
    wall(cell);
  }
  close_up_to(scene.cells.size() + 1);
  for (const TreemapScene::Label& label : scene.labels) draw_label(to, label);
  draw_legend(to, scene.legend);
}

}  // namespace

void draw_treemap_png(const std::string& path, const TreemapScene& scene) {
  paint_png(path, scene.width, scene.height, [&](cairo_t* to) { draw(to, scene); });
}

void draw_treemap_pdf(const std::string& path, const TreemapScene& scene) {
  paint_pdf(path, scene.width, scene.height, {scene.title, scene.description},
            [&](cairo_t* to) { draw(to, scene); });
}

}  // namespace powercell::io
