/// \file
/// Takes a job with one fault after the other, and checks what comes of each.
#pragma once

#include "tests/faults/jobs.hpp"

namespace powercell::test {

/// How many faults came out in which way.
struct Tally {
  std::uint64_t tried = 0, errors = 0, survived = 0;
};

/// Fails each call that `kind` makes, of each entry point that `wanted` holds, once, with `code`. Each time
/// the step in which it fails throws an Error that names the code, or the fault is one that can be survived;
/// taken again in the same object the step works; the results have the bits of a run without faults; nothing
/// of OpenCL is left once the job is gone. \param most  of each entry point at most so many calls, spread
/// over the run; 0: all
Tally fail_every_call(const JobKind& kind, cl_int code, const std::vector<shim::Entry>& wanted,
                      std::uint64_t most = 0);

/// Loses the device at each call that needs it. Everything that is tried with the device from then on fails
/// with an Error or needs no device; once it is back, a new job gives the same bits.
Tally lose_device_everywhere(const JobKind& kind, cl_int code, std::uint64_t most = 0);

/// All entry points of the shim.
std::vector<shim::Entry> all_entries();

}  // namespace powercell::test
