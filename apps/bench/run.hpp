/// \file
/// The benchmark of devices from one end to the other.
#pragma once

#include <string>
#include <vector>

#include "apps/bench/record.hpp"
#include "apps/common.hpp"

namespace powercell::app {

/// What was asked for on the command line; `CommonOptions::device` and `json` are not used.
struct BenchArguments : CommonOptions {
  std::vector<std::string> devices, domains;  ///< none: those that there are
  std::string json_file, compare_file;
  std::size_t n = 0, repeat = 3;
  bool quick = false, cold = false;
  double fail_below = 0;

  /// Whether the table is printed.
  bool talk() const { return !quiet && json_file != "-"; }
};

/// Runs it device by device, domain by domain, precision by precision, and prints the table as it goes.
/// Where arguments name no number of seeds, those of `earlier` (may be null) are taken, else as many as fill
/// the time. \throw Error interrupted; invalid_argument, invalid_file (a domain); device_not_found
BenchRecord run_bench(const BenchArguments& arguments, const EarlierRecord* earlier);

}  // namespace powercell::app
