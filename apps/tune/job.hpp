/// \file
/// What `powercell tune` times: diagrams that are computed again and again with some settings.
#pragma once

#include <memory>
#include <powercell/powercell.hpp>
#include <string>
#include <vector>

#include "apps/common.hpp"
#include "apps/io/tables/read_seeds.hpp"

namespace powercell::app {

struct TuneJob {
  std::string name;  ///< "cube in double"
  Domain domain;
  Precision precision;
  bool in_device_memory;  ///< DeviceDiagram, else Diagram
  io::SeedTable seeds = {};

  int cell_dimension() const { return domain.cell_dimension(); }
};

/// A job on a device with some settings.
class TunedRun {
 public:
  virtual ~TunedRun() = default;
  /// Computes the diagram.
  /// \return seconds, without those of building kernels.
  /// \throw Error internal if the measures of a Diagram do not sum to the domain's
  virtual double time() = 0;
  /// All measures of the last time, the same bits with any settings.
  virtual std::vector<double> measures() const = 0;
};

/// \throw Error if the device cannot run the job with its settings
std::unique_ptr<TunedRun> start(const TuneJob& job, const Device& device, Options options);
/// The same for one in device memory, in a queue of its own.
std::unique_ptr<TunedRun> start_in_device_memory(const TuneJob& job, const DeviceInfo& info,
                                                 const DeviceSettings& settings);

}  // namespace powercell::app
