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

/// A layout to write. Nothing is owned.
struct TreemapOutput {
  const NamedTree& tree;
  const Treemap& map;
  /// n: the numbers that choose the hues of the branches below the root, from number_branches.
  std::span<const std::int64_t> hue;
};

/// Numbers the branches below the root to choose their hues, the largest branch first; close numbers have
/// distant hues. A branch with a number in an earlier layout keeps it, the others get free numbers. \param
/// earlier  n, as in EarlierLayout; may be empty \return n; -1 for all other nodes
std::vector<std::int64_t> number_branches(const Treemap& map, std::span<const std::int64_t> earlier);

struct TreemapStyle {
  double long_side = 1600;  ///< of the picture, pixels
  bool labels = true;
};

inline constexpr std::string_view treemap_outputs = ".svg .png .pdf .json";
/// \throw Error invalid_file if the extension is not among them
void check_treemap_output(const std::string& path);

/// Writes, by the extension of `path`:
/// - .svg .png .pdf: cells coloured by branch, walls wider at higher levels, labels that fit. In SVG a leaf
/// is a
///   `<path data-id="...">` with a title "name: value", in nested groups like those of the tree; coordinates
///   are rounded to a thousandth of a pixel;
/// - .json: a list of {id, parent, name, value, polygon, seed} of groups and leaves, in the coordinates of
/// the outline;
///   numbers read back the same. Branches below the root also have {hue}, their number from number_branches.
///   Dropped nodes are omitted.
/// \throw Error as check_treemap_output; write_failed
void write_treemap(const std::string& path, const TreemapOutput& output, const TreemapStyle& style = {});

}  // namespace powercell::io
