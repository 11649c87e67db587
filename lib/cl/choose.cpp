#include "lib/cl/choose.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <powercell/opencl.hpp>
#include <tuple>
#include <utility>

#include "lib/base/float_environment.hpp"
#include "lib/base/text.hpp"
#include "lib/cl/enumerate.hpp"
#include "lib/cl/errors.hpp"
#include "lib/cl/self_test.hpp"
#include "lib/cl/settings_file.hpp"
#include "lib/report/log.hpp"

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

/// Numbers that a compute unit works on at a time. Makers count units of very different sizes.
unsigned lanes_of(const DeviceInfo& device) {
  struct Maker {
    const char* name;
    unsigned lanes;
  };
  // Multiprocessors of NVIDIA, compute units of AMD, execution units of Intel, cores of Apple.
  constexpr Maker makers[] = {
      {"nvidia", 128}, {"advanced micro", 64}, {"amd", 64}, {"intel", 8}, {"apple", 128}};
  const std::string vendor = lower(device.vendor);
  for (const Maker& maker : makers)
    if (vendor.find(maker.name) != std::string::npos) return maker.lanes;
  return 32;
}

bool better(const DeviceInfo& a, const DeviceInfo& b) {
  const auto rank = [](const DeviceInfo& device) {
    const bool gpu = device.type == DeviceInfo::Type::gpu;
    const int kind = gpu ? 2 : device.type == DeviceInfo::Type::cpu ? 1 : 0;
    const std::uint64_t speed =
        std::uint64_t{gpu ? lanes_of(device) : 1} * device.compute_units * std::max(device.clock_mhz, 1u);
    return std::tuple(kind, gpu && !device.unified_memory, speed);
  };
  return rank(a) > rank(b);
}

std::string not_found_message(std::span<const DeviceInfo> devices, std::string_view selector,
                              std::string_view origin) {
  if (devices.empty()) return no_device_message({});
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

/// Those that a selector stands for that is not "P:D".
std::vector<std::size_t> best_first(std::span<const DeviceInfo> devices, const std::string& selector) {
  std::vector<std::size_t> matching;
  for (std::size_t i = 0; i < devices.size(); ++i)
    if (matches(devices[i], selector)) matching.push_back(i);
  std::stable_sort(matching.begin(), matching.end(),
                   [&](std::size_t a, std::size_t b) { return better(devices[a], devices[b]); });
  return matching;
}

Device open(std::shared_ptr<SharedContext> shared, const DeviceInfo& info) {
  auto context = std::make_shared<Context>(std::move(shared), info);
  self_test(context);
  return Device(std::move(context));
}

Device open(const FoundDevice& found) {
  // A device that was lost fails in its old context, and may work in a new one.
  if (auto shared = SharedContext::of_device(found.device)) try {
      return open(std::move(shared), found.info);
    } catch (const Error& error) {
      if (!is_of_device(error.code())) throw;
    }
  return open(SharedContext::make(found.platform, found.device), found.info);
}

/// Opens `most` devices, the first of `order` that can be opened.
/// \throw Error of the first that cannot, if none can
std::vector<Device> open_those_that_work(const FoundDevices& found, std::span<const std::size_t> order,
                                         std::size_t most) {
  std::vector<Device> opened;
  std::optional<Error> first;
  for (const std::size_t k : order) {
    if (opened.size() == most) break;
    try {
      opened.push_back(open(found.usable[k]));
    } catch (const Error& error) {
      if (!is_of_device(error.code())) throw;
      const DeviceInfo& info = found.usable[k].info;
      write_log(LogLevel::info, [&] {
        return "the device " + info.selector() + " " + info.name + " is set aside: " + error.what();
      });
      if (!first) first = error;
    }
  }
  if (opened.empty() && first) throw *first;
  return opened;
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
    if (devices.empty()) throw Error(ErrorCode::device_not_found, no_device_message({}));
    return best_first(devices, "");
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
  const FloatEnvironment environment;
  const cl::FoundDevices found = cl::find_devices();
  std::vector<DeviceInfo> infos;
  for (const cl::FoundDevice& entry : found.usable) infos.push_back(entry.info);
  if (infos.empty()) throw Error(ErrorCode::device_not_found, cl::no_device_message(found.unusable));
  std::string_view origin;
  if (selector.empty()) {
    if (const char* from_environment = std::getenv("POWERCELL_DEVICE"); from_environment) {
      selector = from_environment;
      origin = " (from the environment variable POWERCELL_DEVICE)";
    }
  }
  const std::string wish = cl::lower(selector);
  if (wish.empty() || wish == "gpu" || wish == "cpu" || wish == "all") {
    const bool all = wish == "all";
    const auto order = cl::best_first(infos, all ? "" : wish);
    if (!order.empty()) return group(cl::open_those_that_work(found, order, all ? order.size() : 1));
  }
  std::vector<std::size_t> chosen;
  try {
    chosen = cl::select_devices(infos, selector, origin);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::device_not_found) throw;
    throw Error(error.code(), error.what() + cl::reasons(found.unusable));
  }
  std::vector<Device> opened;
  for (const std::size_t k : chosen) opened.push_back(cl::open(found.usable[k]));
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
  const FloatEnvironment environment;
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
