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
  std::string json_file, csv_file, plot_file, description;
  std::vector<std::string>
      compare_files;       ///< none; an earlier one; or two that exist, with nothing to measure
  std::size_t n = 0;       ///< seeds; 0: those of every record (sizes.hpp)
  std::size_t repeat = 0;  ///< runs of each kind; 0: until they settle
  bool quick = false, cold = false;
  double fail_below = 0;

  /// Whether the table is printed.
  bool talk() const { return !quiet && json_file != "-" && csv_file != "-"; }
};

/// The names of domains that --domain knows.
std::vector<std::string> bench_domain_names();

/// Runs the benchmark for each device, domain and precision, and prints the rows of the table as they finish.
/// The numbers of seeds are that of the arguments, else those of `earlier` (may be null), else those that
/// every record has.
/// \throw Error interrupted; invalid_argument, invalid_file (a domain); device_not_found
BenchRecord run_bench(const BenchArguments& arguments, const SavedRecord* earlier);

}  // namespace powercell::app
