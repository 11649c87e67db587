#include "apps/io/tables/read_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <powercell/error.hpp>

#include "apps/io/printable.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/tables/read_tree_rows.hpp"

namespace powercell::io {

std::string NamedTree::called(std::size_t node) const {
  if (row.empty() || row[node] == 0) return fmt::format("'{}'", readable(id[node]));
  return fmt::format("'{}' ({}{})", readable(id[node]), readable(rows), row[node]);
}

namespace {

// The sums of the values above 0 of the leaves below each node.
std::vector<double> leaf_sums(const NamedTree& tree, const std::vector<std::size_t>& children) {
  std::vector<double> sum(tree.size(), 0);
  std::vector<std::size_t> open = children, ready;
  for (std::size_t i = 0; i < tree.size(); ++i)
    if (children[i] == 0) ready.push_back(i);
  while (!ready.empty()) {
    const std::size_t i = ready.back();
    ready.pop_back();
    if (children[i] == 0) sum[i] = std::max(tree.value[i], 0.0);
    if (tree.parent[i] < 0) continue;
    const auto above = static_cast<std::size_t>(tree.parent[i]);
    sum[above] += sum[i];
    if (--open[above] == 0) ready.push_back(above);
  }
  return sum;
}

// Values of groups that are no sums are not drawn, which a note has to say.
void note_own_values(NamedTree& tree) {
  constexpr double rounding = 1e-9;
  std::vector<std::size_t> children(tree.size());
  for (const std::int64_t parent : tree.parent)
    if (parent >= 0) ++children[static_cast<std::size_t>(parent)];
  const std::vector<double> sum = leaf_sums(tree, children);
  std::size_t count = 0, first = 0;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const double own = tree.value[i];
    if (children[i] == 0 || own == 0 || std::abs(own - sum[i]) <= rounding * std::max(std::abs(own), sum[i]))
      continue;
    if (count++ == 0) first = i;
  }
  if (count == 0) return;
  tree.notes.push_back(
      fmt::format("groups are drawn with the sums of their leaves; the own values of {} differ and are not "
                  "used: {} has {}, "
                  "its leaves {}{}",
                  count == 1 ? "1 group" : fmt::format("{} groups", count), tree.called(first),
                  tree.value[first], sum[first], count == 1 ? "" : ", ..."));
}

}  // namespace

NamedTree parse_tree(std::string_view bytes, const std::string& extension, const std::string& name,
                     const TreeColumnNames& named) {
  NamedTree tree =
      extension == ".json" ? parse_tree_json(bytes, name, named) : parse_tree_table(bytes, name, named);
  note_own_values(tree);
  tree.colour_column = named.colours;
  if (named.colours.empty()) tree.colour.clear();
  return tree;
}

NamedTree read_tree(const std::string& path, const TreeColumnNames& named) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored))
    return parse_tree(read_file(path), lower_extension(path), path, named);
  for (const auto& [option, column] :
       {std::pair("--color-by", named.colours), {"--value-column", named.value}})
    if (!column.empty())
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("{} {}: {} is a folder, which has no columns; give a table or JSON", option,
                              readable(column), readable(path)));
  return scan_folder(path);
}

}  // namespace powercell::io
