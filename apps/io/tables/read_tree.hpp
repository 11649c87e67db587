/// \file
/// Weighted trees for treemaps from tables, JSON and folders; and earlier layouts.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace powercell::io {

/// A valid tree: one root, no cycle, all values finite. Nodes have the order of the file.
struct NamedTree {
  std::vector<std::string> id;       ///< n, distinct
  std::vector<std::string> name;     ///< n, for people
  std::vector<std::int64_t> parent;  ///< n: index of the parent, -1 for the root
  std::vector<double> value;         ///< n; 0 if the input has no value
  /// n: fields of the colour column, empty where there is none; or nothing if no column was asked for.
  std::vector<std::string> colour;
  std::string colour_column;       ///< its name
  std::vector<std::string> notes;  ///< omissions, e.g. folders that could not be read

  /// For inputs with numbered rows: the prefix of the number, "sales.csv:" or "list.json: element ", and n
  /// numbers, 0 for an implied row. Else empty; ids are paths then.
  std::string rows;
  std::vector<std::size_t> row;

  std::size_t size() const { return id.size(); }
  /// A node in messages: 'north' (sales.csv:12).
  std::string called(std::size_t node) const;
};

/// Columns of a table, or members of the objects of JSON, by name.
struct TreeColumnNames {
  std::string colours;  ///< whose values are colours or stand for some; empty for none
  std::string value;    ///< empty for value, weight or size (in tables also area)
};

/// Reads one of
/// - a folder: its regular files with their sizes in bytes, below their folders; links are not followed;
/// - a .json file: nested objects {name, children, value}, or a list of rows {id, parent, name, value}, such
/// as a file
///   that `write_treemap` writes; `size` and `weight` are accepted for `value`;
/// - any other file: a table of rows id, parent, name, value, separated by commas, semicolons or tabs, with
/// or without
///   a header that names the columns in any order. The root has no parent; a parent 0 without a row is the
///   root too. Without ids the parents are names, as in plotly's labels, parents, values and Google's name,
///   parent, size; from, to, value and the like are links from parents to children.
/// A header without a parent column may name other shapes: `name,value`; `id,value` with paths (a/b/c, or
/// a.b.c if all groups have rows); or the levels from the top down, in the columns before `value`. A first
/// line "sep=;" is skipped. Several roots get a root above them. Values of nodes with children are not used
/// and may be missing; a note tells where they differ from the sum of the leaves.
/// \throw Error invalid_file for a cycle, an orphan, a repeated id, or a value that is not a number (which
/// row)
/// \throw Error invalid_argument if there is no column of a name
NamedTree read_tree(const std::string& path, const TreeColumnNames& named = {});

/// The same from memory.
/// \param extension lower case with its dot
/// \param name  for messages
NamedTree parse_tree(std::string_view bytes, const std::string& extension, const std::string& name,
                     const TreeColumnNames& named = {});

/// Polygons and seeds of an earlier layout for the nodes of the present tree, matched by id.
struct EarlierLayout {
  std::vector<std::int64_t> parent;          ///< n: as in the tree; -1 also if the parent has changed
  std::vector<double> seeds;                 ///< n x 2; NaN if unknown
  std::vector<std::uint64_t> vertex_offset;  ///< n + 1; nodes missing in the layout have no vertices
  std::vector<double> vertices;
  std::vector<std::int64_t> hue;    ///< n: of number_branches; -1 if unknown
  std::vector<std::int64_t> shade;  ///< n: of number_groups; -1 if unknown
  std::size_t known = 0;            ///< number of nodes in the layout
};
/// \throw Error invalid_file if it is not a layout written by `write_treemap` (which element)
EarlierLayout read_earlier_layout(const std::string& path, const NamedTree& tree);
/// The same from memory.
/// \param name  for messages
EarlierLayout parse_earlier_layout(std::string_view bytes, const NamedTree& tree, const std::string& name);

}  // namespace powercell::io
