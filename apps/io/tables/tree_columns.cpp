#include "apps/io/tables/tree_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <powercell/error.hpp>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/io/closest.hpp"
#include "apps/io/printable.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/read/text.hpp"
#include "apps/io/tables/fields.hpp"

namespace powercell::io {
namespace {

using Names = std::span<const std::string_view>;

// Those before are taken rather than those behind.
constexpr std::string_view ids[] = {"id", "ids", "nodeid", "node_id", "node", "key"};
constexpr std::string_view parents[] = {"parent", "parents", "parentid", "parent_id", "parentids"};
// Of these the last column is taken.
constexpr std::string_view names[] = {"name", "names", "label", "labels", "title"};
constexpr std::string_view values[] = {"value", "values", "weight", "weights", "size", "sizes", "area"};
constexpr std::string_view children[] = {"child", "childid", "child_id", "children"};
constexpr std::pair<std::string_view, std::string_view> link_ends[] = {{"from", "to"}, {"source", "target"}};

using ColumnPlace = std::optional<std::size_t>;

ColumnPlace first_named(const std::vector<std::string>& header, Names known) {
  for (const std::string_view name : known)
    if (const auto at = std::find(header.begin(), header.end(), name); at != header.end())
      return static_cast<std::size_t>(at - header.begin());
  return std::nullopt;
}

ColumnPlace last_named(const std::vector<std::string>& header, Names known) {
  ColumnPlace found;
  for (std::size_t f = 0; f < header.size(); ++f)
    if (std::find(known.begin(), known.end(), header[f]) != known.end()) found = f;
  return found;
}

// Also "parent name", parentNode, "Parent category".
ColumnPlace parent_of(const std::vector<std::string>& header) {
  if (const ColumnPlace known = first_named(header, parents)) return known;
  for (std::size_t f = 0; f < header.size(); ++f)
    if (header[f].starts_with("parent")) return f;
  return std::nullopt;
}

}  // namespace

std::string listed(const Fields& header) {
  std::string all;
  for (const auto& field : header) all += (all.empty() ? "" : ", ") + std::string(trimmed(field));
  return readable(all);
}

std::size_t place_of_column(const Fields& header, const char* option, const std::string& column) {
  std::vector<std::string> known;
  for (std::size_t f = 0; f < header.size(); ++f) {
    if (column_name(header[f]) == column_name(column)) return f;
    known.emplace_back(trimmed(header[f]));
  }
  throw Error(ErrorCode::invalid_argument,
              fmt::format("{} {}: there is no such column{}; the table has {}", option, readable(column),
                          did_you_mean(closest(column, known)), listed(header)));
}

std::optional<TreeColumns> find_tree_columns(const Fields& header, const std::string& value,
                                             const std::string& where) {
  std::vector<std::string> known;
  for (const std::string_view field : header) known.push_back(column_name(field));
  TreeColumns columns;
  auto& place = columns.place;
  place[value_column] = value.empty() ? last_named(known, values)
                                      : ColumnPlace(place_of_column(header, "--value-column", value));
  if (place[value_column]) known[*place[value_column]].clear();  // "source" may be the name of the values
  place[id_column] = first_named(known, ids);
  place[parent_column] = parent_of(known);
  place[name_column] = last_named(known, names);
  const auto link = [&](ColumnPlace parent, ColumnPlace child) {
    if (!parent || !child) return;
    place[parent_column] = parent, place[id_column] = child;
    columns.links = true;
  };
  if (!place[id_column]) link(place[parent_column], first_named(known, children));
  for (const auto& [from, to] : link_ends)
    if (!place[id_column] && !place[parent_column])
      link(first_named(known, {&from, 1}), first_named(known, {&to, 1}));
  if (!place[id_column] && place[parent_column] && place[name_column]) {
    place[id_column] = place[name_column];
    columns.names_are_ids = true;
  }
  if (columns.is_linked()) return columns;
  if (!place[value_column] || header.size() < 2) return std::nullopt;
  if (place[parent_column])
    fail_file(where,
              fmt::format("the column {} has parents, but no column is called id or name; call that "
                          "one id which the parents refer to, of {}",
                          readable(std::string(trimmed(header[*place[parent_column]]))), listed(header)));
  return columns;
}

}  // namespace powercell::io
