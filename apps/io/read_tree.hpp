/// \file
/// Weighted trees for treemaps: tables, JSON, folders; and earlier layouts.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace powercell::io {

/// A checked tree: one root, no cycle, every value a finite number. Nodes stand in the order of the file.
struct NamedTree {
  std::vector<std::string> id;       ///< n, distinct
  std::vector<std::string> name;     ///< n, for people
  std::vector<std::int64_t> parent;  ///< n: index of the parent, -1 for the root
  std::vector<double> value;         ///< n; 0 where the input has none
  std::vector<std::string> notes;    ///< what was left out on the way, e.g. folders that could not be read

  /// Where rows are numbered: what the number follows, "sales.csv:" or "list.json: element ", and n numbers,
  /// 0 for a row that was only implied. Else empty: ids are paths.
  std::string rows;
  std::vector<std::size_t> row;

  std::size_t size() const { return id.size(); }
  /// How messages call a node: 'north' (sales.csv:12).
  std::string called(std::size_t node) const;
};

/// Reads, by what `path` is:
/// - a folder: its regular files with their sizes in bytes, below their folders; links are not followed;
/// - .json: nested objects {name, children, value}, or a list of rows {id, parent, name, value} (what
///   `write_treemap` writes is one); `size` and `weight` stand for `value` too;
/// - any other: a table of rows id, parent, name, value, separated by commas, semicolons or tabs, with or
/// without
///   a header that names the columns (in any order). The root has no parent; a parent 0 that has no row of
///   its own is the root too.
/// The value of a node with children is not looked at and may be missing.
/// \throw Error invalid_file: a cycle, an orphan, two roots, an id twice, a value that is no number (which
/// row)
NamedTree read_tree(const std::string& path);

/// The same from memory. \param extension lower case with its dot  \param name  for messages
NamedTree parse_tree(std::string_view bytes, const std::string& extension, const std::string& name);

/// Polygons and seeds of an earlier layout, for the nodes of a tree as it is now, by their ids.
struct EarlierLayout {
  std::vector<std::int64_t> parent;  ///< n: as in the tree; -1 also where the node has another parent now
  std::vector<double> seeds;         ///< n x 2; NaN where there is none
  std::vector<std::uint64_t> vertex_offset;  ///< n + 1; no vertices where the node was not there
  std::vector<double> vertices;
  std::vector<std::int64_t> hue;  ///< n: of number_branches; -1 where there is none
  std::size_t known = 0;          ///< nodes that were there
};
/// \throw Error invalid_file if it is no layout that `write_treemap` wrote (which element)
EarlierLayout read_earlier_layout(const std::string& path, const NamedTree& tree);
/// The same from memory. \param name  for messages
EarlierLayout parse_earlier_layout(std::string_view bytes, const NamedTree& tree, const std::string& name);

}  // namespace powercell::io
