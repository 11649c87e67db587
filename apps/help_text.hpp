/// \file
/// The text of --help.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace CLI {
class FormatterBase;
}

namespace powercell::app {

/// Lines of at most `width` characters where words allow it, each behind `indent` blanks but the first, which
/// begins where `column` characters stand already.
std::string wrapped(const std::string& text, std::size_t column, std::size_t indent, std::size_t width);

/// Names of options in one column, wrapped descriptions with their defaults in another. As wide as the
/// terminal, within reason; 100 characters in files and pipes.
std::shared_ptr<CLI::FormatterBase> help_format();

}  // namespace powercell::app
