#include "lib/cl/enumerate.hpp"

#include <doctest/doctest.h>

#include "tests/cl/support.hpp"

using namespace powercell;

TEST_CASE("every device says what it is and is found by its selector") {
  const auto all = devices();
  REQUIRE_FALSE(all.empty());
  for (const auto& device : all) {
    CAPTURE(device.selector());
    CHECK_FALSE(device.name.empty());
    CHECK_FALSE(device.platform_name.empty());
    CHECK_FALSE(device.driver_version.empty());
    CHECK(device.opencl_c_version.starts_with("OpenCL C "));
    CHECK(device.compute_units > 0);
    const std::string kind = name(device.type);
    CHECK((kind == "cpu" || kind == "gpu" || kind == "accelerator" || kind == "other"));
    CHECK(device.max_work_group_size > 0);
    CHECK(device.largest_allocation >= device.memory_bytes / 8);  // OpenCL asks for a quarter, or 128 MiB
    const auto chosen = Device::choose(device.selector());
    CHECK(chosen.info().selector() == device.selector());
    CHECK(chosen.info().name == device.name);
  }
}

TEST_CASE("child: no platform" * doctest::skip()) {
  CHECK(devices().empty());
  const auto error = error_of([] { Device::choose(); });
  REQUIRE(error);
  CHECK(error->code() == ErrorCode::device_not_found);
  CHECK(contains(error->what(), "pocl-opencl-icd"));
}

TEST_CASE("a machine without OpenCL has no devices, and the error says what to install") {
  // In a process of its own: the loader looks for drivers once.
  TemporaryFolder empty;
  CHECK(
      std::system(("OCL_ICD_VENDORS='" + empty.path().string() + "/' " + child_command("child: no platform"))
                      .c_str()) == 0);
}
