#include "apps/io/read_tree.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "apps/io/printable.hpp"
#include "apps/io/read_file.hpp"
#include "apps/io/read_tree_rows.hpp"

namespace powercell::io {

std::string NamedTree::called(std::size_t node) const {
  if (row.empty() || row[node] == 0) return fmt::format("'{}'", readable(id[node]));
  return fmt::format("'{}' ({}{})", readable(id[node]), readable(rows), row[node]);
}

NamedTree parse_tree(std::string_view bytes, const std::string& extension, const std::string& name) {
  return extension == ".json" ? parse_tree_json(bytes, name) : parse_tree_table(bytes, name);
}

NamedTree read_tree(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return scan_folder(path);
  return parse_tree(read_file(path), lower_extension(path), path);
}

}  // namespace powercell::io
