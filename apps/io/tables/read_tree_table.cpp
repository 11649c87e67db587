// Tables of rows id, parent, name, value, and the shapes without parents: names and values, paths, levels.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <powercell/error.hpp>
#include <unordered_set>

#include "apps/io/printable.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/read/text.hpp"
#include "apps/io/tables/fields.hpp"
#include "apps/io/tables/read_tree_rows.hpp"
#include "apps/io/tables/tree_columns.hpp"

namespace powercell::io {
namespace {

constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

// Spreadsheets may write a first line "sep=;".
std::optional<char> announced_separator(std::string_view text) {
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  if (!text.starts_with("sep=") || text.size() < 5) return std::nullopt;
  const std::string_view rest = text.substr(0, text.find('\n')).substr(4);
  return rest.size() == 1 || (rest.size() == 2 && rest[1] == '\r') ? std::optional(rest[0]) : std::nullopt;
}

// The separator that occurs most often in the first line.
char find_separator(std::string_view text) {
  const std::string_view first = text.substr(0, text.find('\n'));
  char best = ',';
  for (const char c : {';', '\t'})
    if (std::count(first.begin(), first.end(), c) > std::count(first.begin(), first.end(), best)) best = c;
  return best;
}

std::string field_of(const Fields& fields, std::optional<std::size_t> place) {
  return place && *place < fields.size() ? std::string(trimmed(fields[*place])) : std::string();
}

TreeRow read_row(const Fields& fields, const TreeColumns& columns, const std::string& name,
                 std::size_t line) {
  TreeRow row;
  row.place = line;
  row.id = field_of(fields, columns.place[id_column]);
  row.parent = field_of(fields, columns.place[parent_column]);
  row.name = field_of(fields, columns.place[name_column]);
  if (row.id.empty()) fail_line(name, line, "the row has no id");
  if (printable(row.id) != row.id)
    fail_line(name, line, "the id is not valid UTF-8; save the table as UTF-8");
  const std::string value = field_of(fields, columns.place[value_column]);
  if (value.empty()) return row;
  const Parsed parsed = parse_number(value, row.value);
  if (parsed != Parsed::ok)
    fail_line(name, line, fmt::format("the value of '{}': {}", row.id, why_not(value, parsed)));
  return row;
}

// A table without parents: the nodes above the leaves follow from the ids.
class Paths {
 public:
  // \param levels  the columns from the top level down; a single one may hold paths if it is called id
  Paths(std::vector<std::size_t> levels, bool may_split)
      : levels_(std::move(levels)), may_split_(may_split) {}

  TreeRow read(const Fields& fields, TreeColumns columns, const std::string& name, std::size_t line) {
    columns.place[id_column] = levels_.front();
    if (!may_split_) columns.place[name_column] = std::nullopt;
    TreeRow row = read_row(fields, columns, name, line);
    if (levels_.size() == 1) return row;
    row.name = row.id;
    row.id = escaped(row.id);
    for (std::size_t k = 0; k + 1 < levels_.size() && !field_of(fields, levels_[k + 1]).empty(); ++k) {
      row.name = field_of(fields, levels_[k + 1]);
      if (printable(row.name) != row.name)
        fail_line(name, line, "a name is not valid UTF-8; save the table as UTF-8");
      row.id += "/" + escaped(row.name);
    }
    return row;
  }

  // Gives each row its parent and adds the rows that only paths name. Returns what was taken, for a note.
  std::string link(std::vector<TreeRow>& rows) const {
    std::unordered_set<std::string> known;
    for (const TreeRow& row : rows) known.insert(row.id);
    const char split = levels_.size() > 1 ? '/' : separator(rows, known);
    if (split == 0) return {};
    for (std::size_t k = 0; k < rows.size(); ++k) {  // grows
      const std::size_t end = rows[k].id.find_last_of(split);
      if (end == std::string::npos || end == 0) continue;
      std::string above = rows[k].id.substr(0, end);
      if (rows[k].name.empty()) rows[k].name = unescaped(rows[k].id.substr(end + 1));
      rows[k].parent = above;
      if (known.insert(above).second)
        rows.push_back({above, "", above.find(split) == std::string::npos ? unescaped(above) : "", "", 0, 0});
    }
    return levels_.size() > 1 ? "" : fmt::format("ids are taken as paths separated by '{}'", split);
  }

 private:
  // Slashes of names are no levels.
  static std::string escaped(std::string text) {
    for (std::size_t at = 0; (at = text.find('/', at)) != std::string::npos;) text.replace(at, 1, "%2F");
    return text;
  }
  std::string unescaped(std::string text) const {
    if (levels_.size() == 1) return text;
    for (std::size_t at = 0; (at = text.find("%2F", at)) != std::string::npos;) text.replace(at, 3, "/");
    return text;
  }

  // Slashes separate paths; points do if all nodes above have rows, since names hold points too.
  char separator(const std::vector<TreeRow>& rows, const std::unordered_set<std::string>& known) const {
    if (!may_split_) return 0;
    bool points = false, all = true;
    for (const TreeRow& row : rows) {
      if (row.id.find('/', 1) != std::string::npos) return '/';
      const std::size_t end = row.id.find_last_of('.');
      if (end == std::string::npos) continue;
      points = true;
      all &= known.contains(row.id.substr(0, end));
    }
    return points && all ? '.' : char{0};
  }

  std::vector<std::size_t> levels_;
  bool may_split_;
};

// The columns before that of the values; all others if it is the first.
std::vector<std::size_t> level_columns(std::size_t width, std::size_t value,
                                       std::optional<std::size_t> colour) {
  std::vector<std::size_t> levels;
  for (std::size_t f = 0; f < value; ++f)
    if (f != colour) levels.push_back(f);
  const bool first = levels.empty();
  for (std::size_t f = value + 1; f < width && first; ++f)
    if (f != colour) levels.push_back(f);
  if (levels.empty()) levels.push_back(*colour);  // names may choose their colours
  return levels;
}

// Of links from parents to children, those that are nobody's child have no rows.
void add_roots(std::vector<TreeRow>& rows) {
  std::unordered_set<std::string> known;
  for (const TreeRow& row : rows) known.insert(row.id);
  const std::size_t count = rows.size();
  for (std::size_t k = 0; k < count; ++k)
    if (std::string above = rows[k].parent; !above.empty() && known.insert(above).second)
      rows.push_back({std::move(above), "", "", "", 0, 0});
}

// Whether a first row of four fields, none of them a known name, has a name where its value is expected.
bool looks_like_header(const Fields& fields) {
  return is_header(fields) && std::none_of(fields.begin(), fields.end(),
                                           [](std::string_view field) { return trimmed(field).empty(); });
}

std::string described(const Fields& header, const std::vector<std::size_t>& levels) {
  std::string all;
  for (const std::size_t level : levels)
    all += (all.empty() ? "" : ", ") + std::string(trimmed(header[level]));
  return "the levels are taken from the columns " + printable(all);
}

}  // namespace

NamedTree parse_tree_table(std::string_view text, const std::string& name, const TreeColumnNames& named) {
  const std::optional<char> announced = announced_separator(text);
  Records records(text, name, announced ? *announced : find_separator(text));
  TreeColumns columns;
  columns.place = {0, 1, 2, 3};
  std::size_t width = tree_columns;
  Fields fields;
  std::vector<TreeRow> rows;
  std::optional<Paths> paths;
  std::optional<std::size_t> colour;
  std::vector<std::string> notes;
  if (announced) records.next(fields);
  for (bool first = true; records.next(fields); first = false) {
    if (first) {
      if (const auto header = find_tree_columns(fields, named.value, records.place())) {
        columns = *header;
        const auto& places = columns.place;
        width = fields.size();
        if (!named.colours.empty()) colour = place_of_column(fields, "--color-by", named.colours);
        if (!places[value_column])
          fail_line(name, records.line(),
                    fmt::format("the header has no column value, weight, size or area; choose one of {} with "
                                "--value-column",
                                listed(fields)));
        if (places[parent_column]) continue;
        std::vector<std::size_t> levels;
        if (places[id_column]) levels = {*places[id_column]};
        if (levels.empty()) levels = level_columns(width, *places[value_column], colour);
        if (levels.size() > 1) notes.push_back(described(fields, levels));
        paths.emplace(std::move(levels), places[id_column].has_value());
        continue;
      }
    }
    if (first && fields.size() != width)
      fail_line(
          name, records.line(),
          fmt::format("{} fields where 4 are expected (id, parent, name, value); of a header, choose the "
                      "column of the values with --value-column: {}",
                      fields.size(), listed(fields)));
    if (first && looks_like_header(fields))
      fail_line(
          name, records.line(),
          fmt::format("the header names no column of values; choose it with --value-column, and call the "
                      "columns of ids and parents id and parent: {}",
                      listed(fields)));
    if (fields.size() != width)
      fail_line(
          name, records.line(),
          fmt::format("{} fields where {} are expected; quote fields with separators", fields.size(), width));
    rows.push_back(paths ? paths->read(fields, columns, name, records.line())
                         : read_row(fields, columns, name, records.line()));
    rows.back().colour = field_of(fields, colour);
  }
  if (paths)
    if (std::string note = paths->link(rows); !note.empty()) notes.push_back(std::move(note));
  if (!named.colours.empty() && !colour)
    throw Error(ErrorCode::invalid_argument,
                fmt::format("--color-by {}: {} has no header; name its columns in a first line",
                            readable(named.colours), readable(name)));
  if (columns.links) add_roots(rows);
  NamedTree tree = link_rows(
      std::move(rows), name, true,
      columns.names_are_ids ? "names stand for ids here: give a column id too"
      : columns.links       ? "a row is a parent and its child here; name the columns level 1 and level 2 "
                              "if the same name below two parents is no mistake"
                            : "");
  tree.notes.insert(tree.notes.begin(), notes.begin(), notes.end());
  return tree;
}

}  // namespace powercell::io
