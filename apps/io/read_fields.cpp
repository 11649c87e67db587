#include "apps/io/read_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace powercell::io {

std::size_t split_fields(const TextScanner& scanner, std::string_view line, Fields& fields) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  std::size_t count = 0, at = 0;
  const auto take = [&](std::string_view field) {
    if (count == most_columns) scanner.fail(fmt::format("more than {} columns", most_columns));
    fields[count++] = field;
  };
  while (at < line.size()) {
    const std::size_t begin = at;
    if (line[at] == '"') {  // quoted, as in the headers of some spreadsheets
      at = std::min(line.find('"', at + 1), line.size() - 1) + 1;
      take(line.substr(begin + 1, at - begin >= 2 ? at - begin - 2 : 0));
    } else {
      while (at < line.size() && !blank(line[at]) && line[at] != ',' && line[at] != ';') ++at;
      take(line.substr(begin, at - begin));
    }
    while (at < line.size() && blank(line[at])) ++at;
    if (at < line.size() && (line[at] == ',' || line[at] == ';')) {
      ++at;
      while (at < line.size() && blank(line[at])) ++at;
      if (at == line.size()) take({});  // "1,2," has an empty third field
    }
  }
  return count;
}

std::string column_name(std::string_view field) {
  std::string name(trimmed(field));
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

}  // namespace powercell::io
