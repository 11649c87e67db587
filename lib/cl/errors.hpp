/// \file
/// OpenCL status codes as exceptions, beyond `check` of context.hpp. Internal.
#pragma once

#include <string_view>

#include "lib/cl/context.hpp"

namespace powercell::cl {

/// As `check`, at a place where memory is taken: CL_OUT_OF_RESOURCES means memory here, and only here
/// (elsewhere it is also a kernel's registers or a lost device).
void check_allocation(cl_int status, std::string_view what);

}  // namespace powercell::cl
