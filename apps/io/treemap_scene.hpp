/// \file
/// The picture of a treemap, to be drawn as SVG text or by cairo. Internal to the writers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/io/picture_palette.hpp"
#include "apps/io/write_treemap.hpp"

namespace powercell::io {

/// Everything in pixels, y downwards.
struct TreemapScene {
  struct Cell {
    std::uint32_t node;
    Colour fill;  ///< of a leaf
    double wall;  ///< width of the line around it, drawn over everything inside
    bool leaf;
    std::uint64_t first, end;  ///< corners in `points`
  };
  struct Label {
    double x, y, size;  ///< middle of the text, height of an em
    double width;       ///< of the text
    bool bold;
    double opacity;
    std::string text;
  };
  double width = 0, height = 0;
  std::string title, description;
  /// Nodes in preorder, and the number of nodes below each.
  std::vector<Cell> cells;
  std::vector<std::uint32_t> below;
  std::vector<double> points;  ///< x, y pairs
  std::vector<Label> labels;   ///< in drawing order
};

TreemapScene make_treemap_scene(const TreemapOutput& output, const TreemapStyle& style);

/// A colour for each node: the branch below the root sets the hue, deeper nodes vary it.
std::vector<Colour> treemap_colours(const TreemapOutput& output);

/// Adds names that fit into their cells without overlaps, large groups first.
void add_treemap_labels(TreemapScene& scene, const TreemapOutput& output);

void draw_treemap_svg(const std::string& path, const TreemapScene& scene, const TreemapOutput& output);
void draw_treemap_png(const std::string& path, const TreemapScene& scene);
void draw_treemap_pdf(const std::string& path, const TreemapScene& scene);

}  // namespace powercell::io
