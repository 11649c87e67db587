/// \file
/// The picture of a treemap, to be drawn as SVG text or by cairo. Internal to the writers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/io/picture/legend.hpp"
#include "apps/io/picture/palette.hpp"
#include "apps/io/write/treemap.hpp"

namespace powercell::io {

/// Everything in pixels, y downwards.
struct TreemapScene {
  struct Cell {
    std::uint32_t node;
    Colour fill;   ///< of a leaf
    bool striped;  ///< instead: it has no value
    double wall;   ///< width of the line around it, drawn over everything inside
    bool leaf;
    std::uint64_t first, end;  ///< corners in `points`
  };
  struct Label {
    double x, y, size;  ///< middle of the text, height of an em
    double width;       ///< of the text
    bool bold;          ///< of a group: with a halo
    bool light;         ///< on a dark cell
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
  LegendScene legend;
  double stripes = 10;  ///< distance of those of striped cells
};

/// Width of the halo around labels of groups, of an em.
constexpr double label_halo = 0.16;
constexpr double halo_opacity = 0.85;  ///< ink on it is legible over dark cells too

/// The widest wall of cells at that depth.
/// \param scale  of the picture, 1 for 1600 pixels
double widest_wall(std::uint32_t depth, double scale);

TreemapScene make_treemap_scene(const TreemapOutput& output, const TreemapStyle& style);

/// A colour for each node: the branch below the root sets the hue, the group below that the shade, and deeper
/// nodes vary it.
std::vector<Colour> treemap_colours(const TreemapOutput& output);

/// The same, or the values of the tree's colour column with a legend.
/// \param legend  whether one is wanted
Colouring treemap_colouring(const TreemapOutput& output, bool legend);

/// Adds names that fit into their cells, large groups first. No label touches another, nor a wall of its cell
/// or of a cell around it; that of a group lies over the walls within.
/// \param scale  as for widest_wall
void add_treemap_labels(TreemapScene& scene, const TreemapOutput& output, double scale);

void draw_treemap_svg(const std::string& path, const TreemapScene& scene, const TreemapOutput& output);
void draw_treemap_png(const std::string& path, const TreemapScene& scene);
void draw_treemap_pdf(const std::string& path, const TreemapScene& scene);

}  // namespace powercell::io
