/// \file
/// The source text of kernels, with includes expanded.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace powercell::cl {

/// (path below kernels/ with '/', text), ascending by path.
using SourceFiles = std::vector<std::pair<std::string_view, std::string_view>>;

/// Every .cl and .h file of kernels/ as it was when the library was built.
const SourceFiles& embedded_kernels();

/// The text of `file` with each line `#include "path"` replaced by that file of `files` (path relative to
/// kernels/, wherever it is included from) the first time, and by nothing after that: as if every file
/// had an include guard. So includes belong at the top of a file, outside any #if.
/// `#line` directives keep the names and lines of the originals in build logs.
/// \throw Error internal naming file and line for a file that does not exist
std::string expand_includes(const SourceFiles& files, std::string_view file);

}  // namespace powercell::cl
