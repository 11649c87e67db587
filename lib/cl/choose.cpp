#include "lib/cl/choose.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>
#include <powercell/opencl.hpp>
#include <utility>

#include "lib/base/text.hpp"
#include "lib/cl/enumerate.hpp"
#include "lib/cl/self_test.hpp"
#include "lib/cl/settings_file.hpp"

namespace powercell {
namespace cl {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

/// Devices a lower-case selector that is not "P:D" stands for.
bool matches(const DeviceInfo& device, const std::string& selector) {
  if (selector.empty()) return true;
  if (selector == "gpu") return device.type == DeviceInfo::Type::gpu;
  if (selector == "cpu") return device.type == DeviceInfo::Type::cpu;
  return lower(device.name).find(selector) != std::string::npos ||
         lower(device.platform_name).find(selector) != std::string::npos;
}

bool is_indices(std::string_view selector) {
  const auto colon = selector.find(':');
  if (colon == 0 || colon == std::string_view::npos || colon + 1 == selector.size()) return false;
  return std::all_of(selector.begin(), selector.end(),
                     [&](const char& c) { return &c == &selector[colon] || (c >= '0' && c <= '9'); });
}

bool better(const DeviceInfo& a, const DeviceInfo& b) {
  auto rank = [](DeviceInfo::Type type) {
    return type == DeviceInfo::Type::gpu ? 2 : type == DeviceInfo::Type::cpu ? 1 : 0;
  };
  return std::pair(rank(a.type), a.compute_units) > std::pair(rank(b.type), b.compute_units);
}

std::string not_found_message(std::span<const DeviceInfo> devices, std::string_view selector,
                              std::string_view origin) {
  if (devices.empty()) return no_device_message();
  std::string message = "no OpenCL device matches \"" + readable(std::string(selector), 100) + "\"" +
                        std::string(origin) + "; there are";
  const char* separator = " ";
  for (const auto& device : devices) {
    message += separator + device.selector() + " " + device.name + " (" + device.platform_name + ")";
    separator = ", ";
  }
  return message + "; use \"P:D\", a part of a name, \"cpu\" or \"gpu\"";
}

}  // namespace

std::size_t select_device(std::span<const DeviceInfo> devices, std::string_view selector,
                          std::string_view origin) {
  const std::string wanted = lower(selector);
  const bool by_index = is_indices(wanted);
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (by_index ? devices[i].selector() != wanted : !matches(devices[i], wanted)) continue;
    if (!best || better(devices[i], devices[*best])) best = i;
  }
  if (!best) throw Error(ErrorCode::device_not_found, not_found_message(devices, selector, origin));
  return *best;
}

}  // namespace cl

Device Device::choose(std::string_view selector) {
  const auto found = cl::find_devices();
  std::vector<DeviceInfo> infos;
  for (const auto& entry : found) infos.push_back(entry.info);
  std::string_view origin;
  if (selector.empty()) {
    if (const char* from_environment = std::getenv("POWERCELL_DEVICE"); from_environment) {
      selector = from_environment;
      origin = " (from the environment variable POWERCELL_DEVICE)";
    }
  }
  const auto& entry = found[cl::select_device(infos, selector, origin)];
  auto context = std::make_shared<cl::Context>(entry.platform, entry.device, entry.info);
  cl::self_test(context);
  return Device(std::move(context));
}

DeviceSettings settings_of(const Device& device) {
  return device.context()->settings();
}

void use_settings(const Device& device, const DeviceSettings& settings) {
  cl::require_usable(device.info(), settings);
  device.context()->use(settings);
}

Device device_from_queue(cl_command_queue queue) {
  auto context = std::make_shared<cl::Context>(queue);
  cl::self_test(context);
  return Device(std::move(context));
}

const DeviceInfo& Device::info() const {
  return context_->info();
}

double Device::build_seconds() const {
  return context_->build_seconds();
}

}  // namespace powercell
