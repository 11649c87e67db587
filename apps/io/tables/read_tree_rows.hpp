/// \file
/// The readers behind read_tree, and rows that refer to their parents. Internal to the readers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/io/tables/read_tree.hpp"

namespace powercell::io {

struct TreeRow {
  std::string id, parent, name;  ///< the root has an empty parent
  std::string colour;            ///< of NamedTree
  double value = 0;
  std::size_t place = 0;  ///< line of a table, or number of an element of a list from 1
};

/// Links the rows to a tree.
/// \param file  for messages
/// \param lines  whether `place` is a line ("f.csv:12: "), else an element ("f.json: element 12: ")
/// \param repeated  what to do about an id that two rows have; empty if nothing is known
/// \throw Error invalid_file as read_tree
NamedTree link_rows(std::vector<TreeRow> rows, const std::string& file, bool lines,
                    const std::string& repeated = "");

/// The formats of read_tree.
/// \throw Error invalid_file
NamedTree parse_tree_table(std::string_view text, const std::string& name, const TreeColumnNames& named);
NamedTree parse_tree_json(std::string_view text, const std::string& name, const TreeColumnNames& named);
NamedTree scan_folder(const std::string& path);

}  // namespace powercell::io
