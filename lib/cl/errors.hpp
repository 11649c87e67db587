/// \file
/// OpenCL status codes as exceptions, beyond `check` of context.hpp.
#pragma once

#include <string_view>

#include "lib/cl/context.hpp"

namespace powercell::cl {

/// As `check`, after an allocation: there CL_OUT_OF_RESOURCES means memory, while elsewhere it may also mean
/// a kernel's registers or a lost device.
void check_allocation(cl_int status, std::string_view what);

/// As `check`, after a query for which nothing is allocated on the device: drivers without their kernel
/// module answer CL_OUT_OF_HOST_MEMORY.
/// \throw Error opencl
void check_query(cl_int status, std::string_view what);

/// Whether a failure is one of a device, so that another one may do.
bool is_of_device(ErrorCode code);

/// \throw Error unsupported in a process that was forked after OpenCL was used
void require_not_forked();

}  // namespace powercell::cl
