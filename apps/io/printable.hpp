/// \file
/// Text that every program reads alike.
#pragma once

#include <string>

namespace powercell::io {

/// Valid UTF-8 without control characters: what is neither becomes U+FFFD.
std::string printable(const std::string& text);

}  // namespace powercell::io
