/// \file
/// Whether the compiler kept the library's own arithmetic as it is written. Internal.
#pragma once

#include <string>

namespace powercell::cl {

/// Computes known results on the host. \return what is wrong, and for which numbers; empty if all are right
std::string host_arithmetic_fault();

}  // namespace powercell::cl
