/// \file
/// What a caller wrote, for a message. Internal.
#pragma once

#include <cstddef>
#include <string>

namespace powercell {

/// `text` without control characters, so that a message stays on one line and leaves the terminal alone, and
/// cut off after `most` bytes.
std::string readable(std::string text, std::size_t most);

}  // namespace powercell
