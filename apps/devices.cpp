// powercell devices: the devices that --device accepts.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/common.hpp"
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
          {"opencl_c_version", device.opencl_c_version},
          {"driver_version", device.driver_version}};
}

int run(const CommonOptions& options) {
  const std::vector<DeviceInfo> all = devices();
  if (options.json) {
    nlohmann::json list = nlohmann::json::array();
    for (const DeviceInfo& device : all) list.push_back(as_json(device, refusal(options, device)));
    fmt::print("{}\n", json_text({{"devices", list}, {"version", version()}}));
    return 0;
  }
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
      "Each is tested as when it is used; one that computes wrongly is 'refused', with the reason.");
  return [options] { return run(*options); };
}

}  // namespace powercell::app
