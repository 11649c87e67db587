/// \file
/// Bytes as text (RFC 4648).
#pragma once

#include <string_view>

#include "apps/io/atomic_file.hpp"

namespace powercell::io {

/// Writes the digits of `bytes`, padded, on one line.
void write_base64(AtomicFile& file, std::string_view bytes);

}  // namespace powercell::io
