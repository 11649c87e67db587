/// \file
/// The ways of doing one work behind one face, so that they can be run in turns: this library with either
/// provider of neighbours, and its peers.
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
  /// What may be done once for many calls and is not timed: kernels are built, buffers grown. \param seeds
  /// outlive the contender
  virtual void prepare() {}
  /// Before each timed run, not timed: forgets what would make a second run with the same seeds easier.
  virtual void forget() {}
  /// Seeds in host memory to results in host memory.
  virtual void run() = 0;
  /// Of the last run: |sum of the measures / measure of the domain - 1|.
  virtual double relative_error() = 0;
  virtual double tolerance() const = 0;    ///< of relative_error
  virtual std::size_t output_bytes() = 0;  ///< of the results that run() leaves

  std::string stage, precision, provider;
  bool peer = false;
};

/// One of this library. \param stage "measures", "adjacency" (measures and adjacency) or "weights": as
/// adjacency, but only the weights are new since the run before   \param provider "tree" or "flann"
std::unique_ptr<Contender> our_contender(const std::string& stage, const std::string& provider,
                                         Precision precision, const Domain& domain, const SeedArray& seeds);

/// Names of the peers that can do the domain, those with several threads first.
std::vector<std::string> peers_of(const std::string& domain);
/// A peer computes the measures alone (stage "measures"). \throw std::invalid_argument
std::unique_ptr<Contender> peer_contender(const std::string& provider, const Work& work,
                                          double domain_measure, const SeedArray& seeds);

/// False in a build without FLANN.
bool has_flann();
const Device& device();  ///< chosen once, as Device::choose() does

}  // namespace powercell::bench
