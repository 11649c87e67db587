/// \file
/// Runs a job with one fault after the other, and checks the effects.
#pragma once

#include "tests/faults/jobs.hpp"

namespace powercell::test {

/// Numbers of faults by outcome.
struct Tally {
  std::uint64_t tried = 0, errors = 0, survived = 0;
};

/// Fails each call of the entry points in `wanted` once, with `code`. Checks that the step throws an Error
/// that names the code, unless the fault can be survived; that the step succeeds when repeated in the same
/// object; that the results have the bits of a run without faults; and that no OpenCL object is left after
/// the job.
/// \param most  maximum number of calls per entry point, spread over the run; 0 for all
Tally fail_every_call(const JobKind& kind, cl_int code, const std::vector<shim::Entry>& wanted,
                      std::uint64_t most = 0);

/// Loses the device at each call that needs it. Checks that all later calls throw an Error or need no device,
/// and that a new job gives the same bits when the device is back.
Tally lose_device_everywhere(const JobKind& kind, cl_int code, std::uint64_t most = 0);

/// All entry points of the shim.
std::vector<shim::Entry> all_entries();

}  // namespace powercell::test
