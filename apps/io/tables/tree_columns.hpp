/// \file
/// The columns of a table of a tree.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "apps/io/tables/row_source.hpp"

namespace powercell::io {

enum TreeColumn { id_column, parent_column, name_column, value_column, tree_columns };

struct TreeColumns {
  std::array<std::optional<std::size_t>, tree_columns> place;
  /// Rows are links from parents to children, so the root has none: from,to or source,target or parent,child.
  bool links = false;
  bool names_are_ids = false;  ///< as in the tables of plotly and Google: labels,parents,values

  bool is_linked() const { return place[id_column] && place[parent_column]; }
};

/// By a header; none if this is no header.
/// \param value  the name of the column of values; empty to find it
/// \throw Error invalid_argument if there is no such column; invalid_file (`where`) if there are parents and
/// no column of ids
std::optional<TreeColumns> find_tree_columns(const Fields& header, const std::string& value,
                                             const std::string& where);

/// The place of a column in a header.
/// \throw Error invalid_argument
std::size_t place_of_column(const Fields& header, const char* option, const std::string& column);

/// The names of a header, for messages.
std::string listed(const Fields& header);

}  // namespace powercell::io
