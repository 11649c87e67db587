#include "lib/cl/choose.hpp"

#include <doctest/doctest.h>

#include <powercell/opencl.hpp>

#include "tests/cl/support.hpp"

using namespace powercell;

namespace {

DeviceInfo made_up(int platform, int device, const char* platform_name, const char* name,
                   DeviceInfo::Type type, unsigned units) {
  DeviceInfo info;
  info.platform = platform;
  info.device = device;
  info.platform_name = platform_name;
  info.name = name;
  info.type = type;
  info.compute_units = units;
  return info;
}

const std::vector<DeviceInfo> machine = {
    made_up(0, 0, "Portable Computing Language", "pthread-EPYC", DeviceInfo::Type::cpu, 64),
    made_up(1, 0, "Maker CUDA", "Small 100", DeviceInfo::Type::gpu, 8),
    made_up(1, 1, "Maker CUDA", "Large 900", DeviceInfo::Type::gpu, 80),
    made_up(2, 0, "Other", "Board", DeviceInfo::Type::accelerator, 500),
};

std::string chosen(std::string_view selector) {
  return machine[cl::select_device(machine, selector)].name;
}

}  // namespace

TEST_CASE("selectors") {
  CHECK(chosen("") == "Large 900");
  CHECK(chosen("gpu") == "Large 900");
  CHECK(chosen("GPU") == "Large 900");
  CHECK(chosen("cpu") == "pthread-EPYC");
  CHECK(chosen("1:0") == "Small 100");
  CHECK(chosen("2:0") == "Board");
  CHECK(chosen("small") == "Small 100");
  CHECK(chosen("epyc") == "pthread-EPYC");
  CHECK(chosen("PORTABLE") == "pthread-EPYC");
  CHECK(chosen("cuda") == "Large 900");  // of several the best
  const std::vector<DeviceInfo> no_gpu = {machine[3], machine[0]};
  CHECK(cl::select_device(no_gpu, "") == 1);
}

TEST_CASE("lists of selectors") {
  using List = std::vector<std::size_t>;
  CHECK(cl::select_devices(machine, "1:0,cpu") == List{1, 0});
  CHECK(cl::select_devices(machine, "gpu") == List{2});
  CHECK(cl::select_devices(machine, "") == List{2});
  CHECK(cl::select_devices(machine, "ALL") == List{2, 1, 0, 3});  // the best first
  CHECK(cl::select_devices(machine, "board,small,large") == List{3, 1, 2});
  const std::vector<DeviceInfo> comma = {made_up(0, 0, "P", "Card, small", DeviceInfo::Type::gpu, 1)};
  CHECK(cl::select_devices(comma, "card, small") == List{0});
  const auto code = [](std::string_view selectors) {
    const auto error = error_of([&] { cl::select_devices(machine, selectors); });
    REQUIRE(error);
    CHECK(contains(error->what(), std::string(selectors)));
    return error->code();
  };
  CHECK(code("1:1,gpu") == ErrorCode::invalid_argument);  // the same twice
  CHECK(code("cpu,,gpu") == ErrorCode::invalid_argument);
  CHECK(code("cpu,") == ErrorCode::invalid_argument);
  CHECK(code(",") == ErrorCode::invalid_argument);
  const auto error = error_of([] { cl::select_devices(machine, "cpu,teapot"); });
  REQUIRE(error);
  CHECK(error->code() == ErrorCode::device_not_found);
  const auto none = error_of([] { cl::select_devices({}, "all"); });
  REQUIRE(none);
  CHECK(contains(none->what(), "pocl-opencl-icd"));
}

TEST_CASE("an unknown selector is answered with the devices that exist") {
  for (const char* selector : {"9:9", "1:2", "teapot", "1:", ":1", "01:00"}) {
    CAPTURE(selector);
    const auto error = error_of([&] { cl::select_device(machine, selector, " (from X)"); });
    REQUIRE(error);
    CHECK(error->code() == ErrorCode::device_not_found);
    const std::string message = error->what();
    CHECK(contains(message, selector));
    CHECK(contains(message, "\" (from X)"));
    for (const auto& device : machine) CHECK(contains(message, device.selector() + " " + device.name));
  }
  const auto none = error_of([] { cl::select_device({}, "cpu"); });
  REQUIRE(none);
  CHECK(contains(none->what(), "pocl-opencl-icd"));
}

TEST_CASE("POWERCELL_DEVICE counts when no selector is given") {
  {
    Environment variable("POWERCELL_DEVICE", "teapot");
    const auto error = error_of([] { Device::choose(); });
    REQUIRE(error);
    CHECK(error->code() == ErrorCode::device_not_found);
    CHECK(contains(error->what(), "POWERCELL_DEVICE"));
    const std::string selector = devices().front().selector();
    CHECK(Device::choose(selector).info().selector() == selector);
  }
  Environment variable("POWERCELL_DEVICE", devices().back().selector());
  CHECK(Device::choose().info().selector() == devices().back().selector());
}
