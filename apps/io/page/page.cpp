#include "apps/io/page/page.hpp"

#include <algorithm>
#include <powercell/error.hpp>
#include <set>

namespace powercell::io {
namespace {

constexpr std::string_view capitals = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";

constexpr std::string_view import_word = "import ", export_word = "export ";

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    lines.push_back(text.substr(0, text.find('\n')));
    text.remove_prefix(std::min(text.size(), lines.back().size() + 1));
  }
  return lines;
}

/// After the modules that it imports, each of them once.
void append_module(std::string& script, std::string_view name, std::set<std::string_view>& known) {
  if (!known.insert(name).second) return;
  const std::vector<std::string_view> lines = lines_of(view_file(name));
  for (const std::string_view line : lines) {
    if (!line.starts_with(import_word)) continue;
    const std::size_t at = line.rfind("./") + 2;
    append_module(script, line.substr(at, line.rfind('"') - at), known);
  }
  for (std::string_view line : lines) {
    if (line.starts_with(import_word)) continue;
    if (line.starts_with(export_word)) line.remove_prefix(export_word.size());
    script += line;
    script += '\n';
  }
}

}  // namespace

std::string_view view_file(std::string_view name) {
  for (const auto& [file, text] : view_files())
    if (file == name) return text;
  throw Error(ErrorCode::internal, "the tool was built without the page's file " + std::string(name));
}

std::string view_script() {
  std::string script;
  std::set<std::string_view> known;
  append_module(script, "main.js", known);
  return script;
}

std::vector<PagePart> page_parts() {
  std::vector<PagePart> parts;
  std::string_view page = view_file("page.html");
  for (std::size_t at = 0; (at = page.find('@', at)) != std::string_view::npos;) {
    const std::size_t end = page.find_first_not_of(capitals, at + 1);
    if (end == std::string_view::npos || end == at + 1 || page[end] != '@') {
      ++at;
      continue;
    }
    parts.push_back({page.substr(0, at), page.substr(at + 1, end - at - 1)});
    page.remove_prefix(end + 1);
    at = 0;
  }
  parts.push_back({page, {}});
  return parts;
}

}  // namespace powercell::io
