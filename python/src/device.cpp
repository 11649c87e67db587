#include <powercell/device.hpp>
#include <powercell/device_rates.hpp>

#include "python/src/call.hpp"
#include "python/src/options.hpp"

namespace powercell::python {
void bind_devices(nb::module_& m) {
  nb::class_<DeviceInfo>(m, "DeviceInfo", "An OpenCL device of this machine.")
      .def_ro("name", &DeviceInfo::name)
      .def_ro("platform", &DeviceInfo::platform_name)
      .def_ro("vendor", &DeviceInfo::vendor)
      .def_ro("driver", &DeviceInfo::driver_version)
      .def_ro("opencl_c_version", &DeviceInfo::opencl_c_version)
      .def_prop_ro("kind", [](const DeviceInfo& d) { return name(d.type); })
      .def_ro("fp64", &DeviceInfo::fp64)
      .def_ro("compute_units", &DeviceInfo::compute_units)
      .def_ro("clock_mhz", &DeviceInfo::clock_mhz)
      .def_ro("largest_allocation", &DeviceInfo::largest_allocation)
      .def_ro("max_work_group_size", &DeviceInfo::max_work_group_size)
      .def_ro("memory", &DeviceInfo::memory_bytes)
      .def_ro("unified_memory", &DeviceInfo::unified_memory)
      .def_prop_ro("selector", &DeviceInfo::selector);
  m.def("devices", &devices);
  m.def("unusable_devices", [] {
    nb::list all;
    for (const UnusableDevice& one : unusable_devices())
      all.append(nb::make_tuple(one.platform, one.device, one.name, one.reason));
    return all;
  });

  nb::class_<Device>(m, "Device")
      .def_static(
          "choose",
          [](const std::string& selector) {
            return Call(nb::none()).run([&] { return Device::choose(selector); });
          },
          "selector"_a = "")
      .def_static("group", [](const std::vector<Device>& devices) { return Device::group(devices); })
      .def_prop_ro("members", &Device::members)
      .def_prop_ro("info", &Device::info, nb::rv_policy::copy)
      .def_prop_ro("build_seconds", &Device::build_seconds);

  m.def("kernel_builds", [] {
    const KernelBuilds builds = kernel_builds();
    return nb::make_tuple(builds.running, builds.seconds, builds.processor_seconds);
  });
  m.def("measure_device_rates", [](const Device& device, const std::string& precision) {
    const Precision wanted = precision_of(precision);
    const DeviceRates rates = Call(nb::none()).run([&] { return measure_device_rates(device, wanted); });
    return nb::make_tuple(rates.copied_bytes, rates.operations, rates.copied_scatter,
                          rates.operations_scatter);
  });
  m.def("measure_device_latencies", [](const Device& device) {
    const DeviceLatencies latencies = Call(nb::none()).run([&] { return measure_device_latencies(device); });
    return nb::make_tuple(latencies.launch, latencies.transfer, latencies.launch_scatter,
                          latencies.transfer_scatter);
  });
  m.def("measure_device_transfers", [](const Device& device, std::size_t bytes) {
    const DeviceTransfers found =
        Call(nb::none()).run([&] { return measure_device_transfers(device, bytes); });
    return nb::make_tuple(found.to_device, found.to_host, found.to_device_scatter, found.to_host_scatter);
  });
}

}  // namespace powercell::python
