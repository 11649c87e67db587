/// \file
/// The benchmark of devices.
#pragma once

#include <string>
#include <vector>

#include "apps/bench/saved_record.hpp"
#include "apps/common.hpp"

namespace powercell::app {

/// Options of the command line; `CommonOptions::device` and `json` are not used.
struct BenchArguments : CommonOptions {
  std::vector<std::string> devices, domains;  ///< empty for the defaults
  std::string json_file, description;
  std::vector<std::string>
      compare_files;  ///< none; an earlier one; or two that exist, with nothing to measure
  std::size_t n = 0, repeat = 3;
  bool quick = false, cold = false;
  double fail_below = 0;

  /// Whether the table is printed.
  bool talk() const { return !quiet && json_file != "-"; }
};

/// The names of domains that --domain knows.
std::vector<std::string> bench_domain_names();

/// Runs the benchmark for each device, domain and precision, and prints the rows of the table as they finish.
/// The number of seeds is that of the arguments, else that of `earlier` (may be null), else as many as fill
/// the time. \throw Error interrupted; invalid_argument, invalid_file (a domain); device_not_found
BenchRecord run_bench(const BenchArguments& arguments, const SavedRecord* earlier);

}  // namespace powercell::app
