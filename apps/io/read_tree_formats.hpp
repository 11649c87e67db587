/// \file
/// The readers behind read_tree. Each throws Error invalid_file. Internal to the readers.
#pragma once

#include <string>
#include <string_view>

#include "apps/io/read_tree_rows.hpp"

namespace powercell::io {

NamedTree parse_tree_table(std::string_view text, const std::string& name);
NamedTree parse_tree_json(std::string_view text, const std::string& name);
NamedTree scan_folder(const std::string& path);

}  // namespace powercell::io
