#include <powercell/error.hpp>

namespace powercell {

const char* name(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::invalid_argument:
      return "invalid_argument";
    case ErrorCode::invalid_seed:
      return "invalid_seed";
    case ErrorCode::invalid_domain:
      return "invalid_domain";
    case ErrorCode::invalid_file:
      return "invalid_file";
    case ErrorCode::write_failed:
      return "write_failed";
    case ErrorCode::device_not_found:
      return "device_not_found";
    case ErrorCode::no_fp64:
      return "no_fp64";
    case ErrorCode::build_failed:
      return "build_failed";
    case ErrorCode::self_test_failed:
      return "self_test_failed";
    case ErrorCode::out_of_device_memory:
      return "out_of_device_memory";
    case ErrorCode::opencl:
      return "opencl";
    case ErrorCode::unsupported:
      return "unsupported";
    case ErrorCode::interrupted:
      return "interrupted";
    case ErrorCode::not_converged:
      return "not_converged";
    case ErrorCode::internal:
      return "internal";
  }
  return "unknown";  // a value that is not in the enumeration
}

// Defined here, so that the typeinfo is in one library only and the exception can be caught across libraries.
Error::~Error() = default;

}  // namespace powercell
