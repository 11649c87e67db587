/// \file
/// Results of a benchmark, and their JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <powercell/device_rates.hpp>
#include <powercell/powercell.hpp>
#include <string>
#include <vector>

#include "apps/bench/host.hpp"
#include "apps/bench/repeated.hpp"
#include "apps/bench/work.hpp"

namespace powercell::app {

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
  HostState state;            ///< right after the runs
  DeviceRates rates;          ///< of the device in this precision
  std::string failure;        ///< the error if the row failed, else empty

  std::string title() const;           ///< for messages: "cube in double with 1,000 seeds on NAME"
  double scatter() const;              ///< the larger of both kinds of runs
  std::size_t real_bytes() const;      ///< bytes of a number
  double rate() const;                 ///< cells a second, measures
  double adjacency_rate() const;       ///< cells a second, measures and adjacency
  double arithmetic_fraction() const;  ///< counted operations per second over the device's rate
  double bandwidth_fraction() const;   ///< counted bytes per second over the device's copying rate
};

/// A figure that scatters by more is marked: half of what `--fail-below 0.9` is to find could be chance. On
/// an idle machine figures scatter by a few hundredths.
inline constexpr double much_scatter = 0.1;

/// What a device reaches in small kernels in a precision, and in transfers of so many bytes.
struct BenchRates {
  std::string precision;
  DeviceRates rates;
};
struct BenchTransfers {
  std::size_t bytes = 0;
  DeviceTransfers rates;
};

struct BenchDevice {
  DeviceInfo info;
  DeviceLatencies latencies = {};              ///< 0 if they could not be measured
  std::vector<BenchRates> rates = {};          ///< those that could be measured, here and below
  std::vector<BenchTransfers> transfers = {};  ///< ascending
};

/// A row that was not run.
struct LeftOut {
  std::string device, selector, domain, precision;
  std::size_t n = 0;
  std::string reason;
};

struct BenchRecord {
  std::string revision;     ///< of the source, as known to git when the build was configured; may be empty
  std::string date;         ///< ISO 8601, UTC
  std::string description;  ///< the user's words
  HostInfo host;
  int threads = 0;
  bool cold = false;       ///< kernels compiled, not found in a cache
  std::size_t repeat = 0;  ///< runs of each kind; 0: until they settle
  HostState before, after;
  std::optional<double> others;  ///< processors that other programs used meanwhile
  std::vector<BenchDevice> devices;
  std::vector<BenchRow> rows;
  std::vector<LeftOut> left_out;
  double seconds = 0;  ///< of the whole benchmark

  std::size_t failures() const;
  /// The number of failed rows and the first of them; empty if none failed.
  std::string failure() const;
  /// The rows that stand for the devices: of each in the cube, in the first precision that did not fail, that
  /// of most seeds.
  std::vector<const BenchRow*> headlines() const;
};

nlohmann::json as_json(const BenchRecord& record);

}  // namespace powercell::app
