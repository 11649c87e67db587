/// \file
/// For callers with their own OpenCL objects. The only public header that needs the OpenCL headers.
#pragma once

#ifndef CL_TARGET_OPENCL_VERSION
#define CL_TARGET_OPENCL_VERSION 120
#endif
#include <CL/cl.h>

#include <powercell/device.hpp>

namespace powercell {

/// A device that works in the caller's context, on the caller's in-order queue. Both are retained.
/// \throw Error invalid_argument for a null or out-of-order queue; self_test_failed, build_failed, opencl
POWERCELL_API Device device_from_queue(cl_command_queue queue);

}  // namespace powercell
