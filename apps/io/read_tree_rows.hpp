/// \file
/// Rows of a tree that name their parents. Internal to the readers.
#pragma once

#include <string>
#include <vector>

#include "apps/io/read_tree.hpp"

namespace powercell::io {

struct TreeRow {
  std::string id, parent, name;  ///< an empty parent: the root
  double value = 0;
  std::size_t place = 0;  ///< line of a table, or number of an element of a list from 1
};

/// Links the rows. \param file   for messages
/// \param place  how to call a row's place: "f.csv:12: " or "f.json: element 12: "
/// \throw Error invalid_file as read_tree
NamedTree link_rows(std::vector<TreeRow> rows, const std::string& file, bool lines);

}  // namespace powercell::io
