/// \file
/// Results of a benchmark, and their JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <powercell/device_rates.hpp>
#include <powercell/powercell.hpp>
#include <string>
#include <vector>

#include "apps/bench/host.hpp"
#include "apps/bench/work.hpp"

namespace powercell::app {

/// Repeated runs of the same computation, from seeds in host memory to results in host memory.
struct TimedRuns {
  std::vector<double> seconds;  ///< of each run, kernels built before
  Timings phases;               ///< of the fastest

  double best() const;  ///< least seconds; 0 without a run
  /// How much longer than the best the median run took, relative to the best; 0 if there is one run.
  double scatter() const;
};

/// A device, a domain, a precision and a number of seeds.
struct BenchRow {
  std::string device, selector;  ///< name, and "P:D"
  std::string domain;            ///< as --domain names it
  std::string precision, neighbors;
  std::size_t n = 0;          ///< seeds
  std::size_t regions = 0;    ///< convex pieces of the domain
  TimedRuns measures;         ///< measures alone
  TimedRuns adjacency;        ///< measures and adjacency in one pass
  double build = 0;           ///< seconds to compile kernels, or read them from a cache, for both
  double first_result = 0;    ///< seconds from opening the device to the measures of the first seeds
  double relative_error = 0;  ///< of the sum of the measures, the largest of all runs
  Work work;                  ///< counted for a cell
  DeviceRates rates;          ///< of the device in this precision
  std::string failure;        ///< the error if the row failed, else empty

  std::string title() const;           ///< for messages: "cube in double with 1,000 seeds on NAME"
  double scatter() const;              ///< the larger of both kinds of runs
  double rate() const;                 ///< cells a second, measures
  double adjacency_rate() const;       ///< cells a second, measures and adjacency
  double arithmetic_fraction() const;  ///< counted operations per second over the device's rate
  double bandwidth_fraction() const;   ///< counted bytes per second over the device's copying rate
};

/// Runs that scatter by more say too little: half of them are off by more than the tenth that a comparison
/// with `--fail-below 0.9` is to find. On an idle machine rows scatter by a few hundredths.
inline constexpr double much_scatter = 0.1;

/// The row that stands for a device: white seeds in the cube, as many as `headline_seeds` where there is
/// memory.
inline constexpr std::size_t headline_seeds = 1'000'000, quick_headline_seeds = 100'000;
inline constexpr const char* headline_domain = "cube";

struct BenchDevice {
  DeviceInfo info;
  DeviceLatencies latencies;  ///< 0 if they could not be measured
};

struct BenchRecord {
  std::string revision;     ///< of the source, as known to git when the build was configured; may be empty
  std::string date;         ///< ISO 8601, UTC
  std::string description;  ///< the user's words
  HostInfo host;
  int threads = 0;
  bool cold = false;  ///< kernels compiled, not found in a cache
  std::size_t repeat = 0;
  std::vector<BenchDevice> devices;
  std::vector<BenchRow> rows;
  double seconds = 0;  ///< of the whole benchmark

  std::size_t failures() const;
  /// The number of failed rows and the first of them; empty if none failed.
  std::string failure() const;
  /// The rows that stand for the devices: of each the first in the cube that did not fail.
  std::vector<const BenchRow*> headlines() const;
};

nlohmann::json as_json(const BenchRecord& record);

}  // namespace powercell::app
