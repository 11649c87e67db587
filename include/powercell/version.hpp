/// \file
#pragma once

#include <powercell/export.hpp>

#define POWERCELL_VERSION_MAJOR 0
#define POWERCELL_VERSION_MINOR 2
#define POWERCELL_VERSION_PATCH 0
#define POWERCELL_VERSION "0.2.0"

namespace powercell {
/// The version of the linked library, "major.minor.patch".
POWERCELL_API const char* version() noexcept;
}  // namespace powercell
