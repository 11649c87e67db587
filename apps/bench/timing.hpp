/// \file
/// The timed runs of one row of the benchmark.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>

#include "apps/bench/record.hpp"
#include "apps/io/read/domain.hpp"
#include "apps/io/tables/read_seeds.hpp"

namespace powercell::app {

/// The work counted for a cell, by domain and number of seeds; it is the same for every device.
using WorkCounts = std::map<std::pair<std::string, std::size_t>, Work>;

struct BenchTask {
  std::string name;                ///< of the domain
  const io::LoadedDomain* domain;  ///< the caller's
  std::function<Device()> open;    ///< opens the device anew
  Options options;                 ///< precision and so on
  std::size_t n = 0;               ///< seeds
  RunLimits limits = {};           ///< of the runs of measures, and of those of measures and adjacency
  DeviceRates rates = {};          ///< of the device
};

/// Uniform in the domain, weights uniform in [0, h^2 / 2] with h = (measure / n)^(1/d).
io::SeedTable white_seeds(const Domain& domain, std::size_t n);

/// Seconds from seeds in host memory to results there, without building kernels.
double time_once(Diagram& diagram, const io::SeedTable& seeds, bool adjacency);

/// Opens the device, times the first result, and then as many runs as the limits want; every run is checked.
/// Errors are reported in `BenchRow::failure`.
/// \throw Error interrupted
BenchRow time_row(const BenchTask& task, WorkCounts& counts);

/// The largest of 1, 2, 5, 10, 20, ... not above `wanted`, in [1000, 10^7]. There are few values, so that
/// rows of different runs can be compared.
std::size_t round_seeds(double wanted);

/// The fault of the measures of a run; empty if they sum to the domain's within the precision's tolerance and
/// have the same bits as those of `before`, an equal run (may be null).
std::string fault_of(const Measures& measures, Precision precision, const Measures* before);

}  // namespace powercell::app
