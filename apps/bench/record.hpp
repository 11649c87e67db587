/// \file
/// Results of a benchmark, and their JSON.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <powercell/device_rates.hpp>
#include <powercell/powercell.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "apps/bench/work.hpp"

namespace powercell::app {

/// Repeated runs of the same computation, from seeds in host memory to results in host memory.
struct TimedRuns {
  std::vector<double> seconds;  ///< of each run, kernels built before
  Timings phases;               ///< of the fastest

  double best() const;  ///< least seconds; 0 without a run
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
  double rate() const;                 ///< cells a second, measures
  double adjacency_rate() const;       ///< cells a second, measures and adjacency
  double arithmetic_fraction() const;  ///< counted operations per second over the device's rate
  double bandwidth_fraction() const;   ///< counted bytes per second over the device's copying rate
};

struct BenchRecord {
  std::string revision;  ///< of the source, as known to git when the build was configured; may be empty
  std::string date;      ///< ISO 8601, UTC
  int threads = 0;
  bool cold = false;  ///< kernels compiled, not found in a cache
  std::size_t repeat = 0;
  std::vector<DeviceInfo> devices;
  std::vector<BenchRow> rows;
  double seconds = 0;  ///< of the whole benchmark

  std::size_t failures() const;
  /// The number of failed rows and the first of them; empty if none failed.
  std::string failure() const;
};

nlohmann::json as_json(const BenchRecord& record);

/// The part of a row of an earlier record that a comparison needs.
struct EarlierRow {
  std::string device, selector, domain, precision;
  std::size_t n = 0;
  double rate = 0, adjacency_rate = 0;  ///< cells a second
};

struct EarlierRecord {
  std::string path, version, revision, date;
  std::vector<EarlierRow> rows;  ///< those that did not fail

  /// The row of this device, domain, precision and number of seeds (0 for any), or null. Of several devices
  /// with the same name the one with the same selector is preferred.
  const EarlierRow* find(const std::string& device, const std::string& selector, const std::string& domain,
                         const std::string& precision, std::size_t n) const;
};

/// Reads a file written from `as_json`. \throw Error invalid_file
EarlierRecord read_record(const std::string& path);
/// The same from memory. \param name  for messages
EarlierRecord parse_record(std::string_view bytes, const std::string& name);

}  // namespace powercell::app
