/// \file
/// One interface for this library, with either provider of neighbours, and its peers, so that they can be run
/// in turns on the same work.
#pragma once

#include <memory>
#include <powercell/device.hpp>
#include <powercell/options.hpp>
#include <string>
#include <vector>

#include "bench/workload.hpp"

namespace powercell::bench {

class Contender {
 public:
  virtual ~Contender() = default;
  /// Work that is done once for many runs and not timed: builds kernels.
  virtual void prepare() {}
  /// Called before each timed run, not timed: discards results that would speed up a second run with the same
  /// seeds.
  virtual void forget() {}
  /// The timed run, from seeds in host memory to results in host memory.
  virtual void run() = 0;
  /// |sum of the measures / measure of the domain - 1| of the last run.
  virtual double relative_error() = 0;
  virtual double tolerance() const = 0;    ///< of relative_error
  virtual std::size_t output_bytes() = 0;  ///< of the results that run() leaves

  std::string stage, precision, provider;
  bool peer = false;
};

/// This library. The seeds must outlive the contender, as below.
/// \param stage "measures", "adjacency" (measures and adjacency) or "weights" (as adjacency, but only the
/// weights differ from the previous run), "periodic" (as adjacency, in a box with all sides identified)
/// \param provider "tree" or "flann"
std::unique_ptr<Contender> our_contender(const std::string& stage, const std::string& provider,
                                         Precision precision, const Domain& domain, const SeedArray& seeds);

/// Names of the peers that support the domain, those with several threads first.
std::vector<std::string> peers_of(const std::string& domain);
/// A peer computes the measures alone (stage "measures"). \throw std::invalid_argument
std::unique_ptr<Contender> peer_contender(const std::string& provider, const Work& work,
                                          double domain_measure, const SeedArray& seeds);

/// Whether the library was built with FLANN.
bool has_flann();
const Device& device();  ///< the result of Device::choose() on the first call

}  // namespace powercell::bench
