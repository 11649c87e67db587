/// \file
/// Programs from source or from the disk cache.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lib/cl/disk_cache.hpp"
#include "lib/cl/program.hpp"

namespace powercell::cl {

/// Where a program came from.
enum class ProgramOrigin { compiled, disk };

/// One program as it will be handed to the driver.
struct ProgramRequest {
  std::string name;     ///< for messages, e.g. "kernels/cell/polygon.cl"
  std::string source;   ///< with includes expanded
  std::string options;  ///< of clBuildProgram
};

/// "-cl-std=CL1.2", no warnings, and a -D for each of `defines`. Never fast-math: sides are decided in
/// kernels.
/// \throw Error internal for a define with a blank, which no driver could tell from the next option
std::string build_options(const std::vector<std::string>& defines);

/// Names the program on this device with this driver and this version of the library.
CacheKey cache_key(const Context& context, const ProgramRequest& request);

/// Whether compiled programs go to disk: not where the driver keeps them itself (quirks.hpp), unless
/// POWERCELL_CACHE is "always"; nowhere if it is "never".
bool uses_disk_cache(const Context& context);

/// From `cache`, or compiled and then put there. An entry the driver refuses is deleted and replaced.
/// \param cache  may be null
/// \param origin  may be null
/// \throw Error build_failed with device, options and log
std::shared_ptr<const Program> build_program(const Context& context, const ProgramRequest& request,
                                             const DiskCache* cache, ProgramOrigin* origin);

}  // namespace powercell::cl
