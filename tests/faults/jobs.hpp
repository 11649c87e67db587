/// \file
/// Full runs of the library as lists of steps, each of which may fail and be taken again.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/domains.hpp"
#include "tests/support/opencl_shim.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/setups.hpp"

namespace powercell::test {

/// Objects of the library under test, and what they gave. A step that throws is taken again in the same
/// object.
class Job {
 public:
  virtual ~Job() = default;
  virtual std::size_t steps() const = 0;
  virtual void step(std::size_t k) = 0;
  /// Against the results of a run without faults; empty where they have the same bits.
  virtual std::string differences(const Job& other) const = 0;
};

/// A kind of job that can be started any number of times.
struct JobKind {
  std::string name;
  std::function<std::unique_ptr<Job>()> start;
};

/// A Diagram made, given seeds, asked for everything, given weights and asked again in another order.
JobKind diagram_job(const Setup& setup, const NamedDomain& domain, const SeedArray& seeds);
/// A DeviceDiagram on the setup's device, computed twice into buffers of the caller.
JobKind device_diagram_job(const Setup& setup, const NamedDomain& domain, const SeedArray& seeds);
/// Device::choose alone.
JobKind open_job(const Setup& setup);
/// Device::choose and a small diagram on that device: every program is built in the job.
JobKind device_job(const Setup& setup, const NamedDomain& domain, const SeedArray& seeds);

/// A domain of each kind, few seeds: polygon, surface, volume and box, and cells too thin to be told inside.
struct SmallCase {
  NamedDomain domain;
  SeedArray seeds;
};
std::vector<SmallCase> small_cases();
/// One cell of more faces than the first variant of the kernels holds, and of more than any does.
SmallCase many_faces(std::size_t faces);

}  // namespace powercell::test
