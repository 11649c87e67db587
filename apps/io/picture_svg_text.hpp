/// \file
/// Text inside XML.
#pragma once

#include <string>

namespace powercell::io {

/// With the characters that mean something to XML written as entities.
std::string xml_text(const std::string& text);

}  // namespace powercell::io
