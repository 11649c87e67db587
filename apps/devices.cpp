// powercell devices: the devices that --device accepts.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/common.hpp"
#include "apps/driver_probe.hpp"
#include "apps/report.hpp"

namespace powercell::app {
namespace {

/// Why the device cannot be used, as its self-test says; empty if it can.
std::string refusal(CommonOptions options, const DeviceInfo& device) {
  options.device = device.selector();
  try {
    open_device(options);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::interrupted) throw;
    return error.what();
  }
  return {};
}

std::string reason_of(const FatalDriver& driver) {
  return "it ends programs that ask for its devices (" + driver.last_words + ")";
}

nlohmann::json as_json(const UnusableDevice& unusable) {
  return {{"platform", unusable.platform},
          {"device", unusable.device < 0 ? nlohmann::json() : nlohmann::json(unusable.device)},
          {"name", unusable.name},
          {"reason", unusable.reason}};
}

nlohmann::json as_json(const DeviceInfo& device, const std::string& refused) {
  return {{"device", device.selector()},
          {"refused", refused.empty() ? nlohmann::json() : nlohmann::json(refused)},
          {"platform", device.platform_name},
          {"name", device.name},
          {"vendor", device.vendor},
          {"type", name(device.type)},
          {"fp64", device.fp64},
          {"compute_units", device.compute_units},
          {"clock_mhz", device.clock_mhz},
          {"memory_bytes", device.memory_bytes},
          {"largest_allocation", device.largest_allocation},
          {"max_work_group_size", device.max_work_group_size},
          {"unified_memory", device.unified_memory},
          {"opencl_c_version", device.opencl_c_version},
          {"driver_version", device.driver_version}};
}

int run(const CommonOptions& options) {
  if (is_driver_probe()) return 0;
  const std::vector<FatalDriver> fatal = set_fatal_drivers_aside();
  const std::vector<DeviceInfo> all = devices();
  if (options.json) {
    nlohmann::json list = nlohmann::json::array();
    for (const DeviceInfo& device : all) list.push_back(as_json(device, refusal(options, device)));
    nlohmann::json aside = nlohmann::json::array();
    for (const UnusableDevice& unusable : unusable_devices()) aside.push_back(as_json(unusable));
    for (const FatalDriver& driver : fatal)
      aside.push_back({{"driver", driver.file}, {"reason", reason_of(driver)}});
    fmt::print("{}\n", json_text({{"devices", list}, {"set_aside", aside}, {"version", version()}}));
    return 0;
  }
  for (const FatalDriver& driver : fatal)
    fmt::print(stderr,
               "powercell: note: the driver of {} is set aside: {}; other commands need that file removed, "
               "or OCL_ICD_VENDORS "
               "set to a folder without it\n",
               driver.file, io::one_line(reason_of(driver)));
  if (all.empty()) Device::choose();  // throws, and says why there is none
  fmt::print("{:<8}{:<6}{:<6}{:>6}{:>12}  {}\n", "device", "type", "fp64", "units", "memory", "name");
  for (const DeviceInfo& device : all) {
    fmt::print("{:<8}{:<6}{:<6}{:>6}{:>8.1f} GiB  {} ({}, {})\n", device.selector(), name(device.type),
               device.fp64 ? "yes" : "no", device.compute_units,
               static_cast<double>(device.memory_bytes) / (1024.0 * 1024.0 * 1024.0), device.name,
               device.platform_name, device.driver_version);
    if (const std::string refused = refusal(options, device); !refused.empty())
      fmt::print("        refused: {}\n", io::one_line(refused));
  }
  for (const UnusableDevice& unusable : unusable_devices()) {
    const bool whole = unusable.device < 0;
    fmt::print("{:<8}{} {}: set aside: {}\n",
               whole ? fmt::format("{}:*", unusable.platform)
                     : fmt::format("{}:{}", unusable.platform, unusable.device),
               whole ? "the platform" : "the device", unusable.name, io::one_line(unusable.reason));
  }
  return 0;
}

}  // namespace

Command add_devices(CLI::App& app) {
  auto options = std::make_shared<CommonOptions>();
  CLI::App* command = app.add_subcommand("devices", "List the OpenCL devices that --device accepts");
  add_output_options(*command, *options);
  command->footer(
      "Examples:\n  powercell devices\n  powercell devices --json\n"
      "Any part of a name, or the number in the first column, chooses a device:\n"
      "  powercell diagram --device 0:0 ...     powercell diagram --device nvidia ...\n"
      "Each is tested as when it is used; one that computes wrongly is 'refused', with the reason.\n"
      "What OpenCL lists but cannot describe is 'set aside', and the rest goes on.");
  return [options] { return run(*options); };
}

}  // namespace powercell::app
