// Every OpenCL call of full runs fails once, and the device is lost at each call that needs it. Most jobs try
// only a few calls of each entry point here; all calls of all jobs, with more error codes, are
//   test_faults --no-skip -tc='campaign*'
#include <doctest/doctest.h>

#include "lib/cl/context.hpp"
#include "tests/faults/sweep.hpp"
#include "tests/support/environment.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

std::vector<JobKind> jobs_on(const Setup& setup) {
  std::vector<JobKind> jobs;
  for (const SeededDomain& small : small_cases()) {
    jobs.push_back(diagram_job(setup, small.domain, small.seeds));
    if (setup.options.neighbors == Neighbors::tree)
      jobs.push_back(device_diagram_job(setup, small.domain, small.seeds));
  }
  const SeededDomain undecided = ties();
  const SeededDomain periodic = periodic_ties();
  if (setup.options.neighbors == Neighbors::tree) {
    jobs.push_back(device_diagram_job(setup, undecided.domain, undecided.seeds));
    jobs.push_back(device_diagram_job(setup, periodic.domain, periodic.seeds));
  }
  return jobs;
}

/// Whether an entry point is used for opening devices and building programs, and not in every launch.
bool of_opening(shim::Entry entry) {
  using shim::Entry;
  switch (entry) {
    case Entry::clCreateBuffer:
    case Entry::clCreateUserEvent:
    case Entry::clEnqueueBarrierWithWaitList:
    case Entry::clEnqueueFillBuffer:
    case Entry::clEnqueueMapBuffer:
    case Entry::clEnqueueMarkerWithWaitList:
    case Entry::clEnqueueMigrateMemObjects:
    case Entry::clEnqueueNDRangeKernel:
    case Entry::clEnqueueReadBuffer:
    case Entry::clEnqueueUnmapMemObject:
    case Entry::clEnqueueWriteBuffer:
    case Entry::clReleaseEvent:
    case Entry::clReleaseMemObject:
    case Entry::clSetKernelArg:
    case Entry::clWaitForEvents:
      return false;
    default:
      return true;
  }
}

std::vector<shim::Entry> opening_entries() {
  std::vector<shim::Entry> list = all_entries();
  std::erase_if(list, [](shim::Entry entry) { return !of_opening(entry); });
  return list;
}

void report(const JobKind& job, cl_int code, const Tally& tally) {
  CHECK(tally.errors > 0);
  MESSAGE(job.name, ", ", cl::error_name(code), ": ", tally.tried, " faults, ", tally.errors, " errors, ",
          tally.survived, " survived");
}

}  // namespace

TEST_CASE("every call of a run fails once: an error, no leak, and the object stays usable") {
  const SeededDomain cube = small_cases()[3];
  const JobKind job = diagram_job(main_setups().front(), cube.domain, cube.seeds);
  report(job, CL_OUT_OF_RESOURCES, fail_every_call(job, CL_OUT_OF_RESOURCES, all_entries()));
}

TEST_CASE("calls of every entry point fail in every kind of run") {
  for (const Setup& setup : all_inputs() ? all_setups() : main_setups())
    for (const JobKind& job : jobs_on(setup))
      report(job, CL_OUT_OF_RESOURCES, fail_every_call(job, CL_OUT_OF_RESOURCES, all_entries(), 2));
}

TEST_CASE("faults with a cell of more faces than the kernels' capacities") {
  const SeededDomain many = many_faces(300);
  for (const Setup& setup : main_setups()) {
    std::vector<JobKind> jobs{diagram_job(setup, many.domain, many.seeds)};
    if (setup.options.neighbors == Neighbors::tree)
      jobs.push_back(device_diagram_job(setup, many.domain, many.seeds));
    for (const JobKind& job : jobs)
      report(job, CL_OUT_OF_RESOURCES, fail_every_call(job, CL_OUT_OF_RESOURCES, all_entries(), 2));
  }
}

TEST_CASE("the device is lost: errors, no leak, and correct results when it is back") {
  for (const Setup& setup : main_setups())
    for (const JobKind& job : jobs_on(setup))
      report(job, CL_DEVICE_NOT_AVAILABLE, lose_device_everywhere(job, CL_DEVICE_NOT_AVAILABLE, 7));
}

TEST_CASE("opening a device fails at every call") {
  const JobKind job = open_job(main_setups().front());
  report(job, CL_OUT_OF_HOST_MEMORY,
         fail_every_call(job, CL_OUT_OF_HOST_MEMORY, all_entries(), all_inputs() ? 0 : 3));
}

TEST_CASE("every program of a run fails to build") {
  // A program from the disk cache that fails to build would be compiled instead.
  const Environment compiled("POWERCELL_CACHE", "never");
  const SeededDomain cube = small_cases()[3];
  const JobKind job = device_job(main_setups().front(), cube.domain, cube.seeds);
  report(job, CL_BUILD_PROGRAM_FAILURE,
         fail_every_call(job, CL_BUILD_PROGRAM_FAILURE, {shim::Entry::clBuildProgram}));
}

TEST_CASE("campaign: every call of every run fails, under several codes" * doctest::skip()) {
  for (const Setup& setup : all_setups())
    for (const JobKind& job : jobs_on(setup))
      for (const cl_int code : {CL_OUT_OF_RESOURCES, CL_MEM_OBJECT_ALLOCATION_FAILURE})
        report(job, code, fail_every_call(job, code, all_entries()));
}

TEST_CASE("campaign: the device is lost at every call" * doctest::skip()) {
  for (const Setup& setup : all_setups())
    for (const JobKind& job : jobs_on(setup))
      report(job, CL_OUT_OF_RESOURCES, lose_device_everywhere(job, CL_OUT_OF_RESOURCES));
}

// Each fault opens a device and compiles all programs, which takes seconds. The hundreds of launches and
// buffers of the device's self-test and the first diagrams are left out; the first test fails all such calls.
TEST_CASE("campaign: every call fails that opens the device and builds its programs" * doctest::skip()) {
  const Environment compiled("POWERCELL_CACHE", "never");
  const SeededDomain polygon = small_cases().front();  // needs the most programs of all kinds of domain
  for (const Setup& setup : all_setups()) {
    if (setup.options.neighbors != Neighbors::tree) continue;
    const JobKind job = device_job(setup, polygon.domain, polygon.seeds);
    report(job, CL_OUT_OF_RESOURCES, fail_every_call(job, CL_OUT_OF_RESOURCES, opening_entries()));
  }
}
