/// \file
/// Treemaps as pictures and as data.
#pragma once

#include <cstdint>
#include <powercell/treemap.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/io/tables/read_tree.hpp"

namespace powercell::io {

/// A layout to write. Nothing is owned.
struct TreemapOutput {
  const NamedTree& tree;
  const Treemap& map;
  /// n: the numbers that choose the hues of the branches below the root, from number_branches.
  std::span<const std::int64_t> hue;
  /// n: the shades of the groups two levels below the root, from number_groups.
  std::span<const std::int64_t> shade;
};

/// Numbers the branches below the root to choose their hues, the largest branch first; close numbers have
/// distant hues. A branch with a number in an earlier layout keeps it, the others get free numbers.
/// \param earlier  n, as in EarlierLayout; may be empty
/// \return n; -1 for all other nodes
std::vector<std::int64_t> number_branches(const Treemap& map, std::span<const std::int64_t> earlier);

/// Shades, from 0 to group_shades - 1, of the groups two levels below the root: groups of a branch with a
/// common border differ, unless earlier shades forbid it. A group keeps its shade of an
/// earlier layout if that allows it.
/// \param parent  n, as in the tree
/// \param earlier  n, as in EarlierLayout; may be empty
/// \return n; -1 for all other nodes
std::vector<std::int64_t> number_groups(const Treemap& map, std::span<const std::int64_t> parent,
                                        std::span<const std::int64_t> earlier);
constexpr std::int64_t group_shades = 6;

/// To be called before a long computation.
/// \throw Error invalid_argument if the colour column has more texts than can be told apart
void check_tree_colours(const NamedTree& tree);

struct TreemapStyle {
  double long_side = 1600;  ///< of the picture, pixels
  bool labels = true;
  bool legend = true;  ///< of the tree's colour column
};

inline constexpr std::string_view treemap_outputs = ".svg .png .pdf .json";
/// \throw Error invalid_file if the extension is not among them
void check_treemap_output(const std::string& path);

/// Writes, by the extension of `path`:
/// - .svg .png .pdf: cells coloured by branch, or by the tree's colour column with a legend; walls wider at
/// higher levels, labels that fit. In SVG a leaf is a
///   `<path data-id="...">` with a title "name: value", in nested groups like those of the tree; coordinates
///   are rounded to a thousandth of a pixel;
/// - .json: a list of {id, parent, name, value, polygon, seed} of groups and leaves, in the coordinates of
/// the outline;
///   numbers read back the same. Branches below the root also have {hue}, their number from number_branches,
///   and groups below those {shade}, from number_groups. Dropped nodes are omitted.
/// \throw Error as check_treemap_output; write_failed
void write_treemap(const std::string& path, const TreemapOutput& output, const TreemapStyle& style = {});

}  // namespace powercell::io
