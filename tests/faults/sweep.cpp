#include "tests/faults/sweep.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <optional>

#include "lib/cl/context.hpp"

namespace powercell::test {
namespace {

using shim::Entry;

/// Whether a fault need not cause an error: the object was released, the query has an alternative, or smaller
/// chunks are tried.
bool may_be_survived(Entry entry, cl_int code) {
  switch (entry) {
    case Entry::clReleaseCommandQueue:
    case Entry::clReleaseContext:
    case Entry::clReleaseEvent:
    case Entry::clReleaseKernel:
    case Entry::clReleaseMemObject:
    case Entry::clReleaseProgram:
    case Entry::clGetProgramBuildInfo:  // the log of a program that does not build
    case Entry::clGetProgramInfo:       // the binary for the disk cache
    case Entry::clGetEventInfo:         // why an event failed, or whether it is done
    case Entry::clWaitForEvents:        // for a write whose buffer is released; others are in transfers.cpp
    case Entry::clCreateBuffer:
    case Entry::clEnqueueMigrateMemObjects:
    case Entry::clEnqueueMapBuffer:
      return true;
    default:
      return code == CL_MEM_OBJECT_ALLOCATION_FAILURE || code == CL_OUT_OF_HOST_MEMORY;
  }
}

/// Calls whose number depends on how fast the device is: what is done need not be waited for.
bool depends_on_speed(Entry entry) {
  return entry == Entry::clWaitForEvents || entry == Entry::clGetEventInfo;
}

/// Runs all steps. After the first error it stops the fault and repeats the step. Returns the error, if any.
std::optional<Error> run_steps(Job& job) {
  std::optional<Error> failure;
  for (std::size_t k = 0; k < job.steps(); ++k) {
    try {
      job.step(k);
    } catch (const Error& error) {
      REQUIRE_MESSAGE(!failure, error.what());
      failure = error;
      shim::behave();
      --k;
    }
  }
  return failure;
}

void check_reason(const Error& error, cl_int code) {
  const std::string what = error.what();
  CHECK_MESSAGE(what.find(cl::error_name(code)) != std::string::npos, what);
  const bool expected = error.code() == ErrorCode::opencl || error.code() == ErrorCode::build_failed ||
                        error.code() == ErrorCode::out_of_device_memory ||
                        error.code() == ErrorCode::device_not_found;  // no other one is there
  CHECK_MESSAGE(expected, name(error.code()), ": ", what);
}

void check_nothing_left(const shim::Alive& before, int wrong_before) {
  const shim::Alive after = shim::alive();
  CHECK_MESSAGE(after == before, shim::to_string(after), "instead of ", shim::to_string(before));
  CHECK(shim::wrong_releases() == wrong_before);
}

/// A run without faults, after another one that built the programs of a device that outlives the job.
std::unique_ptr<Job> undisturbed(const JobKind& kind, shim::Calls& calls, std::uint64_t& device_calls) {
  shim::behave();
  run_steps(*kind.start());
  auto job = kind.start();
  shim::reset_calls();
  REQUIRE_FALSE(run_steps(*job));
  calls = shim::calls();
  device_calls = shim::device_calls();
  return job;
}

/// The numbers of 1 to `count` to try: all, or `most` of them, including the first and the last.
std::vector<std::uint64_t> numbers(std::uint64_t count, std::uint64_t most) {
  std::vector<std::uint64_t> list;
  const std::uint64_t tried = most == 0 ? count : std::min(most, count);
  for (std::uint64_t k = 0; k < tried; ++k)
    list.push_back(tried == 1 ? count : 1 + k * (count - 1) / (tried - 1));
  return list;
}

}  // namespace

std::vector<Entry> all_entries() {
  std::vector<Entry> list;
  for (std::size_t e = 0; e < shim::entry_count; ++e) list.push_back(static_cast<Entry>(e));
  return list;
}

Tally fail_every_call(const JobKind& kind, cl_int code, const std::vector<Entry>& wanted,
                      std::uint64_t most) {
  const shim::Scope scope;
  INFO(kind.name << ", " << cl::error_name(code));
  shim::Calls calls{};
  std::uint64_t device_calls = 0;
  const auto reference = undisturbed(kind, calls, device_calls);
  Tally tally;
  for (const Entry entry : wanted)
    for (const std::uint64_t nth : numbers(calls[static_cast<std::size_t>(entry)], most)) {
      INFO("call " << nth << " of " << std::string(shim::name(entry)));
      const shim::Alive before = shim::alive();
      const int wrong_before = shim::wrong_releases();
      {
        const auto job = kind.start();
        shim::fail(entry, nth, code);
        const std::optional<Error> failure = run_steps(*job);
        const bool fired = shim::fired();
        shim::behave();
        if (!fired && depends_on_speed(entry)) continue;
        CHECK(fired);
        ++tally.tried;
        ++(failure ? tally.errors : tally.survived);
        if (failure) check_reason(*failure, code);
        if (!failure) CHECK(may_be_survived(entry, code));
        CHECK(job->differences(*reference) == "");
      }
      check_nothing_left(before, wrong_before);
    }
  return tally;
}

Tally lose_device_everywhere(const JobKind& kind, cl_int code, std::uint64_t most) {
  const shim::Scope scope;
  INFO(kind.name << ", device lost: " << cl::error_name(code));
  shim::Calls calls{};
  std::uint64_t device_calls = 0;
  const auto reference = undisturbed(kind, calls, device_calls);
  Tally tally;
  for (const std::uint64_t nth : numbers(device_calls, most)) {
    INFO("lost at call " << nth);
    const shim::Alive before = shim::alive();
    const int wrong_before = shim::wrong_releases();
    {
      const auto job = kind.start();
      shim::lose_device(nth, code);
      bool failed = false;
      for (std::size_t k = 0; k < job->steps(); ++k) {
        try {
          job->step(k);
        } catch (const Error& error) {
          failed = true;
          check_reason(error, code);
          break;
        }
      }
      CHECK(shim::fired());
      CHECK(failed);
      ++tally.tried;
      ++tally.errors;
    }
    check_nothing_left(before, wrong_before);  // while it is lost
    shim::behave();
    const auto again = kind.start();
    CHECK_FALSE(run_steps(*again));
    CHECK(again->differences(*reference) == "");
  }
  return tally;
}

}  // namespace powercell::test
