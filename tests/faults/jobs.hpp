/// \file
/// Full runs of the library as lists of steps, each of which may fail and be repeated.
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

/// Objects of the library under test and their results. A step that throws is repeated in the same object.
class Job {
 public:
  virtual ~Job() = default;
  virtual std::size_t steps() const = 0;
  virtual void step(std::size_t k) = 0;
  /// Compares the results to those of a run without faults; empty if they have the same bits.
  virtual std::string differences(const Job& other) const = 0;
};

/// A kind of job, which can be started repeatedly.
struct JobKind {
  std::string name;
  std::function<std::unique_ptr<Job>()> start;
};

/// Makes a Diagram, sets seeds, computes everything, sets weights and computes everything in another order.
JobKind diagram_job(const Setup& setup, const NamedDomain& domain, const SeedArray& seeds);
/// Computes a DeviceDiagram on the setup's device into buffers of the caller, with walls too, and repairs it
/// twice; a mesh then once more with a density.
JobKind device_diagram_job(const Setup& setup, const NamedDomain& domain, const SeedArray& seeds);
/// Only Device::choose.
JobKind open_job(const Setup& setup);
/// A device in a context of its own and a small diagram on it, so that every program is built in the job.
JobKind device_job(const Setup& setup, const NamedDomain& domain, const SeedArray& seeds);

/// Few seeds in a polygon, on a surface, in a volume, in a box, and in strips, with cells too thin to be
/// classified as inside or outside.
std::vector<SeededDomain> small_cases();
/// A square with one cell of this many faces.
SeededDomain many_faces(std::size_t faces);
/// A square with a grid of seeds, of which all cells tie.
SeededDomain ties();
/// The same in a periodic square.
SeededDomain periodic_ties();

}  // namespace powercell::test
