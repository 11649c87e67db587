/// \file
/// Text from files, made safe for messages, XML and UTF-8.
#pragma once

#include <string>

namespace powercell::io {

/// Valid UTF-8 without control characters: other bytes become U+FFFD.
std::string printable(const std::string& text);

/// With the characters that have a meaning in XML written as entities.
std::string xml_text(const std::string& text);

/// Control characters become '?': the text stays on one line and does not control the terminal.
std::string one_line(std::string text);

/// On one line, and cut off where it would fill the terminal.
std::string readable(std::string text);

/// "12,345".
std::string with_commas(std::size_t number);

}  // namespace powercell::io
