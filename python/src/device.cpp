#include <powercell/device.hpp>

#include "python/src/call.hpp"

namespace powercell::python {
void bind_devices(nb::module_& m) {
  nb::class_<DeviceInfo>(m, "DeviceInfo", "An OpenCL device of this machine.")
      .def_ro("name", &DeviceInfo::name)
      .def_ro("platform", &DeviceInfo::platform_name)
      .def_ro("vendor", &DeviceInfo::vendor)
      .def_ro("driver", &DeviceInfo::driver_version)
      .def_prop_ro("kind", [](const DeviceInfo& d) { return name(d.type); })
      .def_ro("fp64", &DeviceInfo::fp64)
      .def_ro("compute_units", &DeviceInfo::compute_units)
      .def_ro("memory", &DeviceInfo::memory_bytes)
      .def_prop_ro("selector", &DeviceInfo::selector);
  m.def("devices", [] {
    require_same_process();
    return devices();
  });
  m.def("require_same_process", &require_same_process);

  nb::class_<Device>(m, "Device")
      .def_static(
          "choose",
          [](const std::string& selector) {
            return Call(nb::none()).run([&] { return Device::choose(selector); });
          },
          "selector"_a = "")
      .def_prop_ro("info", &Device::info, nb::rv_policy::copy)
      .def_prop_ro("build_seconds", &Device::build_seconds);
}

}  // namespace powercell::python
