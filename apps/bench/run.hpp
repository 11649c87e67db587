/// \file
/// The benchmark of devices.
#pragma once

#include <string>
#include <vector>

#include "apps/bench/record.hpp"
#include "apps/common.hpp"

namespace powercell::app {

/// Options of the command line; `CommonOptions::device` and `json` are not used.
struct BenchArguments : CommonOptions {
  std::vector<std::string> devices, domains;  ///< empty for the defaults
  std::string json_file, compare_file;
  std::size_t n = 0, repeat = 3;
  bool quick = false, cold = false;
  double fail_below = 0;

  /// Whether the table is printed.
  bool talk() const { return !quiet && json_file != "-"; }
};

/// Runs the benchmark for each device, domain and precision, and prints the rows of the table as they finish.
/// The number of seeds is that of the arguments, else that of `earlier` (may be null), else as many as fill
/// the time. \throw Error interrupted; invalid_argument, invalid_file (a domain); device_not_found
BenchRecord run_bench(const BenchArguments& arguments, const EarlierRecord* earlier);

}  // namespace powercell::app
