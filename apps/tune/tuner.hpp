/// \file
/// Measures which settings of a device are faster.
#pragma once

#include <functional>
#include <powercell/device_settings.hpp>
#include <string>
#include <vector>

#include "apps/common.hpp"
#include "apps/tune/choice.hpp"

namespace powercell::app {

/// `CommonOptions::precision` and so on are not used.
struct TuneArguments : CommonOptions {
  std::vector<std::string> only;  ///< names of settings; empty for all
  std::size_t n = 0, repeat = 5;  ///< seeds, 0: by time; runs of each value
  bool dry_run = false, reset = false;
};

/// A setting with the values that were tried, the one in use first.
struct TuneStep {
  std::string setting;  ///< or "all": where it began, then what was chosen, once more
  std::vector<std::string> jobs;
  std::vector<std::size_t> seeds;  ///< of each job
  std::vector<Trial> trials;
  std::size_t chosen = 0;  ///< which trial
};

struct TuneRecord {
  DeviceInfo device;
  DeviceSettings defaults;
  DeviceSettings before;  ///< where it began: the defaults, or with `only` those in use
  DeviceSettings chosen;
  std::vector<TuneStep> steps;
};

/// Changes one setting after the other where that is faster beyond the scatter of the runs, and at the end
/// times the result against where it began once more.
/// \param said  called after each step
/// \throw Error interrupted; internal if results depend on a setting, which they must not
TuneRecord tune(const TuneArguments& arguments, const std::function<void(const TuneStep&)>& said);

}  // namespace powercell::app
