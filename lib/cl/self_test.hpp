/// \file
/// Tests whether a device computes as OpenCL specifies. Internal.
#pragma once

#include <memory>

#include "lib/cl/context.hpp"

namespace powercell::cl {

/// Runs small computations with known results, in float and, where the device has it, in double.
/// \throw Error self_test_failed naming the device and the wrong result
void self_test(const std::shared_ptr<Context>& context);

}  // namespace powercell::cl
