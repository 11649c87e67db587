// Tables of rows id, parent, name, value.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "apps/io/printable.hpp"
#include "apps/io/read_fields.hpp"
#include "apps/io/read_file.hpp"
#include "apps/io/read_text.hpp"
#include "apps/io/read_tree_rows.hpp"

namespace powercell::io {
namespace {

enum Column { id_column, parent_column, name_column, value_column, columns };

constexpr std::array<std::array<std::string_view, 4>, columns> headings = {
    {{"id", "nodeid", "node", "key"},
     {"parent", "parentid", "parent_id", ""},
     {"name", "label", "title", ""},
     {"value", "weight", "size", "area"}}};

// The separator that occurs most often in the first line.
char find_separator(std::string_view text) {
  const std::string_view first = text.substr(0, text.find('\n'));
  char best = ',';
  for (const char c : {';', '\t'})
    if (std::count(first.begin(), first.end(), c) > std::count(first.begin(), first.end(), best)) best = c;
  return best;
}

using Places = std::array<std::optional<std::size_t>, columns>;

// The places of the columns, if this is a header.
std::optional<Places> read_header(const Fields& fields) {
  Places places;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const std::string heading = column_name(fields[f]);
    for (std::size_t c = 0; c < columns; ++c)
      if (!heading.empty() && std::find(headings[c].begin(), headings[c].end(), heading) != headings[c].end())
        places[c] = f;
  }
  if (!places[id_column] || !places[parent_column]) return std::nullopt;
  return places;
}

std::string field_of(const Fields& fields, std::optional<std::size_t> place) {
  return place && *place < fields.size() ? std::string(trimmed(fields[*place])) : std::string();
}

TreeRow read_row(const Fields& fields, const Places& places, const std::string& name, std::size_t line) {
  TreeRow row;
  row.place = line;
  row.id = field_of(fields, places[id_column]);
  row.parent = field_of(fields, places[parent_column]);
  row.name = field_of(fields, places[name_column]);
  if (row.id.empty()) fail_line(name, line, "the row has no id");
  if (printable(row.id) != row.id)
    fail_line(name, line, "the id is not valid UTF-8; save the table as UTF-8");
  const std::string value = field_of(fields, places[value_column]);
  if (value.empty()) return row;
  const Parsed parsed = parse_number(value, row.value);
  if (parsed != Parsed::ok)
    fail_line(name, line, fmt::format("the value of '{}': {}", row.id, why_not(value, parsed)));
  return row;
}

}  // namespace

NamedTree parse_tree_table(std::string_view text, const std::string& name) {
  Records records(text, name, find_separator(text));
  Places places = {0, 1, 2, 3};
  std::size_t width = columns;
  Fields fields;
  std::vector<TreeRow> rows;
  for (bool first = true; records.next(fields); first = false) {
    if (first) {
      if (const auto header = read_header(fields)) {
        places = *header;
        width = fields.size();
        if (!places[value_column])
          fail_line(name, records.line(), "the header has no column value, weight or size");
        continue;
      }
    }
    if (fields.size() != width)
      fail_line(name, records.line(),
                fmt::format(
                    "{} fields where {} are expected (id, parent, name, value; quote fields with separators)",
                    fields.size(), width));
    rows.push_back(read_row(fields, places, name, records.line()));
  }
  return link_rows(std::move(rows), name, true);
}

}  // namespace powercell::io
