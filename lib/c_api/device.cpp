#include <powercell/device_rates.hpp>

#include "lib/c_api/handles.hpp"
#include "lib/c_api/results.hpp"

namespace powercell::c_api {
namespace {

static_assert(static_cast<int>(DeviceInfo::Type::other) == PC_DEVICE_OTHER);

/// All devices, their structs, and pointers to these.
struct DeviceList {
  std::vector<DeviceText> text;
  std::vector<pc_device_info> info;
  std::vector<const pc_device_info*> devices;
  std::vector<UnusableDevice> unusable;
  std::vector<pc_unusable_device> unusable_views;
  std::vector<const pc_unusable_device*> unusable_pointers;
};

void hand_over_list(const pc_device_list** list, std::vector<DeviceInfo> infos,
                    std::vector<UnusableDevice> unusable = {}) {
  DeviceList all;
  for (DeviceInfo& info : infos) all.text.emplace_back(std::move(info));
  all.unusable = std::move(unusable);
  hand_over_result(list, std::move(all), [](pc_device_list& to, DeviceList& from) {
    for (const DeviceText& text : from.text) from.info.push_back(text.view());
    from.devices = pointers(from.info);
    to.count = from.devices.size();
    to.devices = pointer(from.devices);
    for (const UnusableDevice& one : from.unusable)
      from.unusable_views.push_back({one.platform, one.device, one.name.c_str(), one.reason.c_str()});
    from.unusable_pointers = pointers(from.unusable_views);
    to.unusable_count = from.unusable_pointers.size();
    to.unusable = pointer(from.unusable_pointers);
  });
}

}  // namespace

DeviceText::DeviceText(DeviceInfo info) : owned(std::move(info)), selector(owned.selector()) {}

pc_device_info DeviceText::view() const {
  pc_device_info to{};
  to.platform = owned.platform;
  to.device = owned.device;
  to.platform_name = owned.platform_name.c_str();
  to.name = owned.name.c_str();
  to.vendor = owned.vendor.c_str();
  to.driver_version = owned.driver_version.c_str();
  to.opencl_c_version = owned.opencl_c_version.c_str();
  to.selector = selector.c_str();
  to.kind = static_cast<pc_device_kind>(owned.type);
  to.fp64 = owned.fp64;
  to.compute_units = owned.compute_units;
  to.clock_mhz = owned.clock_mhz;
  to.memory_bytes = owned.memory_bytes;
  to.largest_allocation = owned.largest_allocation;
  to.max_work_group_size = owned.max_work_group_size;
  to.unified_memory = owned.unified_memory;
  return to;
}

}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

extern "C" {

const char* pc_device_kind_name(pc_device_kind kind) {
  const int number = number_in(kind);
  if (number < PC_DEVICE_CPU || number > PC_DEVICE_OTHER) return "unknown";
  return name(static_cast<DeviceInfo::Type>(number));
}

pc_status pc_device_list_create(const pc_device_list** list) {
  return guarded([&] {
    result_at(list);
    hand_over_list(list, devices(), unusable_devices());
  });
}

void pc_device_list_destroy(const pc_device_list* list) {
  destroy_result<DeviceList>(list);
}

pc_status pc_device_create(const char* selector, pc_device** device) {
  return guarded([&] {
    result_at(device);
    hand_over(device, Device::choose(selector ? selector : ""));
  });
}

pc_status pc_device_group_create(const pc_device* const* devices, size_t count, pc_device** group) {
  return guarded([&] {
    result_at(group);
    std::vector<Device> members;
    for (const pc_device* const device : rows_view(devices, count, 1, "devices"))
      members.push_back(device_in(device));
    hand_over(group, Device::group(members));
  });
}

pc_status pc_device_members(const pc_device* device, const pc_device_list** list) {
  return guarded([&] {
    result_at(list);
    std::vector<DeviceInfo> infos;
    for (const Device& member : device_in(device).members()) infos.push_back(member.info());
    hand_over_list(list, std::move(infos));
  });
}

void pc_device_destroy(pc_device* device) {
  delete device;
}

const char* pc_device_name(const pc_device* device) {
  return device ? device->info.name : nullptr;
}

pc_status pc_device_info_view(const pc_device* device, const pc_device_info** info) {
  return guarded([&] { result_at(info) = &checked(device, "device").info; });
}

pc_status pc_device_build_seconds(const pc_device* device, double* seconds) {
  return guarded([&] { result_at(seconds) = device_in(device).build_seconds(); });
}

pc_status pc_kernel_builds(int* running, double* seconds, double* processor_seconds) {
  return guarded([&] {
    const KernelBuilds builds = kernel_builds();
    if (running) *running = builds.running;
    if (seconds) *seconds = builds.seconds;
    if (processor_seconds) *processor_seconds = builds.processor_seconds;
  });
}

pc_status pc_device_rates(const pc_device* device, pc_precision precision, double* copied_bytes,
                          double* operations) {
  return guarded([&] {
    const auto chosen = value_of<Precision>(precision, PC_FLOAT32, "precision", "pc_precision");
    const DeviceRates rates = measure_device_rates(device_in(device), chosen);
    if (copied_bytes) *copied_bytes = rates.copied_bytes;
    if (operations) *operations = rates.operations;
  });
}

pc_status pc_device_latencies(const pc_device* device, double* launch, double* transfer) {
  return guarded([&] {
    const DeviceLatencies latencies = measure_device_latencies(device_in(device));
    if (launch) *launch = latencies.launch;
    if (transfer) *transfer = latencies.transfer;
  });
}

pc_status pc_device_transfers(const pc_device* device, size_t bytes, double* to_device, double* to_host) {
  return guarded([&] {
    const DeviceTransfers transfers = measure_device_transfers(device_in(device), bytes);
    if (to_device) *to_device = transfers.to_device;
    if (to_host) *to_host = transfers.to_host;
  });
}

}  // extern "C"
