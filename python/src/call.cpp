#include "python/src/call.hpp"

#include <unistd.h>

#include <powercell/error.hpp>

namespace powercell::python {

void require_same_process() {
  static const pid_t first = getpid();  // set by the call that opens the first device
  if (getpid() != first)
    throw Error(ErrorCode::unsupported,
                "this process was forked from one that has used powercell, and OpenCL does not survive that: "
                "start processes with multiprocessing's method 'spawn' or 'forkserver'");
}

}  // namespace powercell::python
