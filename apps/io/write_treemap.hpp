/// \file
/// Treemaps as pictures and as data.
#pragma once

#include <cstdint>
#include <powercell/treemap.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/io/read_tree.hpp"

namespace powercell::io {

/// A layout as the writers see it; nothing is owned.
struct TreemapOutput {
  const NamedTree& tree;
  const Treemap& map;
  /// n: the number of the hue of a branch below the root, as number_branches gives it.
  std::span<const std::int64_t> hue;
};

/// Numbers the branches below the root, for their hues, the largest first: hues of numbers that are near are
/// far apart. A branch that has a number in an earlier layout keeps it, the others take those that are free.
/// \param earlier  n, as in EarlierLayout; empty: none
/// \return n; -1 for nodes that are no branch
std::vector<std::int64_t> number_branches(const Treemap& map, std::span<const std::int64_t> earlier);

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
///   outline; numbers read back the same. Branches below the root have their {hue} too, the number that
///   number_branches gave. Dropped nodes are left out.
/// \throw Error as check_treemap_output; write_failed
void write_treemap(const std::string& path, const TreemapOutput& output, const TreemapStyle& style = {});

}  // namespace powercell::io
