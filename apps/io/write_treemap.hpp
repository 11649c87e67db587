/// \file
/// Treemaps as pictures and as data.
#pragma once

#include <powercell/treemap.hpp>
#include <string>
#include <string_view>

#include "apps/io/read_tree.hpp"

namespace powercell::io {

/// A layout as the writers see it; nothing is owned.
struct TreemapOutput {
  const NamedTree& tree;
  const Treemap& map;
};

struct TreemapStyle {
  double long_side = 1600;  ///< of the picture, pixels
  bool labels = true;
};

/// Extensions that `write_treemap` knows, for messages.
std::string_view known_treemap_outputs();
/// \throw Error invalid_file if the extension is not among them
void check_treemap_output(const std::string& path);

/// Writes, by the extension of `path`:
/// - .svg .png .pdf: cells coloured by branch, walls wider the higher their level, labels where they fit. In
/// SVG
///   a leaf is `<path data-id="...">` with a title "name: value", in nested groups, one a group of the tree;
///   coordinates are rounded to a thousandth of a pixel;
/// - .json: a list of {id, parent, name, value, polygon, seed}, groups and leaves, in the coordinates of the
///   outline; numbers read back the same. Dropped nodes are left out.
/// \throw Error as check_treemap_output; write_failed
void write_treemap(const std::string& path, const TreemapOutput& output, const TreemapStyle& style = {});

}  // namespace powercell::io
