/// \file
/// The one exception type of powercell.
#pragma once

#include <powercell/standard_library.hpp>
#include <stdexcept>
#include <string>

namespace powercell {

/// The kind of a failure; `Error::what()` gives the details in words.
enum class ErrorCode {
  invalid_argument,      ///< sizes that do not match, an option out of range
  invalid_seed,          ///< NaN or infinity in a position or weight (which seed)
  invalid_domain,        ///< self-intersection, index out of range, empty domain (which element)
  invalid_file,          ///< unreadable, truncated or malformed file (file and line), unknown extension
  write_failed,          ///< a file could not be written whole
  device_not_found,      ///< no device matches the selector (the message lists the devices)
  no_fp64,               ///< double precision requested on a device without it
  build_failed,          ///< a kernel did not compile (device, options and log in the message)
  self_test_failed,      ///< the device computed a known diagram incorrectly
  out_of_device_memory,  ///< an allocation failed, even in the smallest chunks
  opencl,                ///< any other OpenCL error (name and place in the message)
  unsupported,           ///< this build or device does not have the feature
  interrupted,           ///< the progress callback asked to stop
  not_converged,         ///< an iteration ended above its tolerance
  internal,              ///< an invariant of the library does not hold: please report
};

/// Stable lower-case name of a code, e.g. "invalid_seed".
POWERCELL_API const char* name(ErrorCode code) noexcept;

class POWERCELL_API Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ~Error() override;
  ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace powercell
