#include "lib/cl/choose.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <iterator>
#include <numeric>
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
  return message +
         "; use \"P:D\", a part of a name, \"cpu\" or \"gpu\", several of these with commas between, or "
         "\"all\"";
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

std::vector<std::size_t> select_devices(std::span<const DeviceInfo> devices, std::string_view selectors,
                                        std::string_view origin) {
  std::vector<std::size_t> chosen;
  if (lower(selectors) == "all") {
    if (devices.empty()) throw Error(ErrorCode::device_not_found, no_device_message());
    chosen.resize(devices.size());
    std::iota(chosen.begin(), chosen.end(), std::size_t{0});
    std::stable_sort(chosen.begin(), chosen.end(),
                     [&](std::size_t a, std::size_t b) { return better(devices[a], devices[b]); });
    return chosen;
  }
  // A name may contain a comma itself.
  const bool is_name = std::any_of(devices.begin(), devices.end(), [&](const DeviceInfo& device) {
    return matches(device, lower(selectors));
  });
  if (is_name || selectors.find(',') == std::string_view::npos)
    return {select_device(devices, selectors, origin)};
  for (std::size_t begin = 0, end = 0; end != selectors.size(); begin = end + 1) {
    end = std::min(selectors.find(',', begin), selectors.size());
    const std::string_view selector = selectors.substr(begin, end - begin);
    if (selector.empty())
      throw Error(ErrorCode::invalid_argument, "the list of devices \"" +
                                                   readable(std::string(selectors), 100) + "\"" +
                                                   std::string(origin) + " has an empty name");
    const std::size_t found = select_device(devices, selector, origin);
    if (std::find(chosen.begin(), chosen.end(), found) != chosen.end())
      throw Error(ErrorCode::invalid_argument, "the device " + devices[found].selector() + " " +
                                                   devices[found].name + " is named twice in \"" +
                                                   readable(std::string(selectors), 100) + "\"" +
                                                   std::string(origin));
    chosen.push_back(found);
  }
  return chosen;
}

void require_single(const Device& device, std::string_view what) {
  const std::size_t count = device.members().size();
  if (count > 1)
    throw Error(ErrorCode::unsupported, std::string(what) + " one device, and this is a group of " +
                                            std::to_string(count) + "; give one of its members");
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
  std::vector<Device> opened;
  for (const std::size_t k : cl::select_devices(infos, selector, origin)) {
    const cl::FoundDevice& entry = found[k];
    auto context = std::make_shared<cl::Context>(entry.platform, entry.device, entry.info);
    cl::self_test(context);
    opened.emplace_back(std::move(context));
  }
  return group(opened);
}

Device Device::group(std::span<const Device> devices) {
  std::vector<std::shared_ptr<cl::Context>> contexts;
  for (const Device& device : devices) {
    contexts.push_back(device.context_);
    contexts.insert(contexts.end(), device.others_.begin(), device.others_.end());
  }
  if (contexts.empty()) throw Error(ErrorCode::invalid_argument, "a group needs at least one device");
  for (std::size_t k = 0; k < contexts.size(); ++k)
    if (std::find(contexts.begin(), contexts.begin() + static_cast<std::ptrdiff_t>(k), contexts[k]) !=
        contexts.begin() + static_cast<std::ptrdiff_t>(k))
      throw Error(ErrorCode::invalid_argument, "the device " + contexts[k]->info().selector() + " " +
                                                   contexts[k]->info().name + " is twice in a group");
  Device result(std::move(contexts.front()));
  result.others_.assign(std::make_move_iterator(contexts.begin() + 1),
                        std::make_move_iterator(contexts.end()));
  return result;
}

std::vector<Device> Device::members() const {
  std::vector<Device> all{Device(context_)};
  for (const std::shared_ptr<cl::Context>& context : others_) all.emplace_back(context);
  return all;
}

DeviceSettings settings_of(const Device& device) {
  cl::require_single(device, "settings are those of");
  return device.context()->settings();
}

void use_settings(const Device& device, const DeviceSettings& settings) {
  cl::require_single(device, "settings are those of");
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
  double sum = context_->build_seconds();
  for (const std::shared_ptr<cl::Context>& context : others_) sum += context->build_seconds();
  return sum;
}

}  // namespace powercell
