/// \file
/// The part of a Diagram that never changes. Internal.
#pragma once

#include <powercell/device.hpp>
#include <powercell/domain.hpp>
#include <powercell/options.hpp>

#include "lib/pairs/pair_finder.hpp"
#include "lib/scene/domain_buffers.hpp"

namespace powercell {

/// The precision that the option means on this device. \throw Error no_fp64
Precision choose_precision(const Device& device, Precision asked);

struct Setup {
  Device device;
  Domain domain;
  Options options;
  Precision precision;  ///< as chosen
  Neighbors neighbors;  ///< as chosen
  int threads;
  bool has_inside;          ///< a cell can lie inside the domain and meet several of its regions
  RegionMesh clip_mesh;     ///< where it can: the regions, and the container behind them
  DomainBuffers on_device;  ///< of `clip_mesh`, or of the domain
  PairFinder pairs;

  /// \throw Error no_fp64; invalid_argument, unsupported (options); opencl
  Setup(Device device, Domain domain, Options options);
  bool float32() const { return on_device.float32(); }
};

}  // namespace powercell
