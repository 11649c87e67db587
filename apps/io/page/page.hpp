/// \file
/// The files of apps/io/page/page, from which pages are made.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace powercell::io {

/// (name, text) of each file, ascending, as they were when the tool was built.
const std::vector<std::pair<std::string_view, std::string_view>>& view_files();

/// The text of one of them.
/// \throw Error internal if there is none of that name
std::string_view view_file(std::string_view name);

/// main.js and the modules that it needs as one, each after those that it imports: without the lines that
/// begin with `import`, and without the word `export`. So each import is one line, and names differ between
/// files.
std::string view_script();

/// A part of page.html: `text`, then what the name `after` stands for; the last part has no name.
struct PagePart {
  std::string_view text, after;
};
/// page.html, divided at names of upper case letters between two @.
std::vector<PagePart> page_parts();

}  // namespace powercell::io
