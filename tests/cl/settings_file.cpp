#include "lib/cl/settings_file.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <powercell/log.hpp>
#include <powercell/version.hpp>

#include "lib/cl/quirks.hpp"
#include "tests/cl/support.hpp"

using namespace powercell;
namespace fs = std::filesystem;

namespace {

DeviceInfo some_device() {
  DeviceInfo device;
  device.platform_name = "Some Platform";
  device.vendor = "Maker & Sons";
  device.name = "Device 9 \n(rev 2)";
  device.driver_version = "1.2.3";
  device.type = DeviceInfo::Type::gpu;
  device.compute_units = 10;
  device.max_work_group_size = 256;
  return device;
}

constexpr DeviceSettings others{64, 4, 1, 5000, 1u << 20};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// Lines of the log while it exists.
class Log {
 public:
  Log() {
    set_log([this](LogLevel, std::string_view line) { text_.append(line).append("\n"); });
  }
  ~Log() { set_log({}); }
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace

TEST_CASE("settings come back from the text that is written for them") {
  const DeviceInfo device = some_device();
  for (const DeviceSettings& settings : {DeviceSettings{}, others, default_settings(device)}) {
    const auto read = cl::parse_settings(device, cl::settings_text(device, settings));
    CHECK(read.fault == "");
    REQUIRE(read.settings);
    CHECK(*read.settings == settings);
  }
}

TEST_CASE("settings of anything else than this device, driver and library are not believed") {
  const DeviceInfo device = some_device();
  const std::string text = cl::settings_text(device, others);
  const auto fault_on = [&](auto change) {
    DeviceInfo other = device;
    change(other);
    const auto read = cl::parse_settings(other, text);
    CHECK_FALSE(read.settings);
    return read.fault;
  };
  CHECK(contains(fault_on([](DeviceInfo& d) { d.platform_name = "Other"; }),
                 "its platform is 'Some Platform', not 'Other'"));
  CHECK(contains(fault_on([](DeviceInfo& d) { d.vendor = ""; }), "its vendor"));
  CHECK(contains(fault_on([](DeviceInfo& d) { d.name = "Device 90"; }), "its device"));
  CHECK(contains(fault_on([](DeviceInfo& d) { d.type = DeviceInfo::Type::cpu; }),
                 "its type is 'gpu', not 'cpu'"));
  CHECK(contains(fault_on([](DeviceInfo& d) { d.driver_version = "1.2.4"; }),
                 "its driver is '1.2.3', not '1.2.4'"));
  const auto earlier = cl::parse_settings(
      device, replaced(text, std::string("library ") + POWERCELL_VERSION, "library 0.0.9"));
  CHECK_FALSE(earlier.settings);
  CHECK(contains(earlier.fault, "its library is '0.0.9'"));
}

TEST_CASE("malformed settings are not believed") {
  const DeviceInfo device = some_device();
  const std::string text = cl::settings_text(device, others);
  const auto fault_of = [&](const std::string& changed) {
    const auto read = cl::parse_settings(device, changed);
    CHECK_FALSE(read.settings);
    CHECK(read.fault.size() < 600);
    return read.fault;
  };
  for (std::size_t size = 0; size + 1 < text.size(); ++size) {  // the last newline may be missing
    CAPTURE(size);
    CHECK(fault_of(text.substr(0, size)) != "");
  }
  CHECK(contains(fault_of(text + "more"), "'end'"));
  CHECK(contains(fault_of(text + text), "'end'"));
  CHECK(contains(fault_of(replaced(text, "settings 1", "settings 2")), "settings 1"));
  CHECK(contains(fault_of(replaced(text, "group_size 64", "group_size")), "'group_size'"));
  CHECK(contains(fault_of(replaced(text, "group_size 64", "group_size ")), "'group_size'"));
  CHECK(contains(fault_of(replaced(text, "group_size 64", "group_size -64")), "'group_size'"));
  CHECK(contains(fault_of(replaced(text, "group_size 64", "group_size 64 ")), "'group_size'"));
  CHECK(contains(fault_of(replaced(text, "group_size 64", "group_size 6.4e1")), "'group_size'"));
  CHECK(contains(fault_of(replaced(text, "group_size 64\n", "group_size 64\ngroup_size 64\n")),
                 "'polygon_lanes'"));
  CHECK(contains(fault_of(replaced(text, "chunk_pairs 5000", "chunk_pairs 99999999999999999999")),
                 "'chunk_pairs'"));
  CHECK(contains(fault_of(text + std::string(5000, ' ')), "longer"));
  CHECK(contains(fault_of(replaced(text, "\nvendor ", "\r\nvendor ")), "its platform"));
}

TEST_CASE("settings out of range are neither believed nor written") {
  const DeviceInfo device = some_device();
  const std::string text = cl::settings_text(device, others);
  const auto fault_of = [&](const std::string& from, const std::string& to) {
    const auto read = cl::parse_settings(device, replaced(text, from, to));
    CHECK_FALSE(read.settings);
    return read.fault;
  };
  CHECK(contains(fault_of("group_size 64", "group_size 0"), "group_size is out of range"));
  CHECK(contains(fault_of("group_size 64", "group_size 48"), "group_size is out of range: 48"));
  CHECK(contains(fault_of("group_size 64", "group_size 512"), "group_size is 512, the device permits 256"));
  CHECK(contains(fault_of("polygon_lanes 4", "polygon_lanes 2"), "polygon_lanes is out of range"));
  CHECK(contains(fault_of("polyhedron_lanes 1", "polyhedron_lanes 4294967297"),
                 "polyhedron_lanes is out of range"));
  CHECK(contains(fault_of("chunk_pairs 5000", "chunk_pairs 1000"), "chunk_pairs is out of range"));
  CHECK(
      contains(fault_of("launch_pairs 1048576", "launch_pairs 4294967296"), "launch_pairs is out of range"));
  DeviceSettings wrong = others;
  wrong.polygon_lanes = 3;
  TemporaryFolder folder;
  const Environment cache("POWERCELL_CACHE_DIR", folder.path().string());
  CHECK_THROWS_WITH_AS(save_settings(device, wrong), doctest::Contains("polygon_lanes is out of range: 3"),
                       Error);
  CHECK(fs::is_empty(folder.path()));
  CHECK_THROWS_WITH_AS(use_settings(test_device(), wrong), doctest::Contains("polygon_lanes"), Error);
}

TEST_CASE(
    "a device is opened with the settings in its file, and with the defaults where that is not believed") {
  TemporaryFolder folder;
  const Environment cache("POWERCELL_CACHE_DIR", (folder.path() / "made").string());
  const DeviceInfo device = test_device().info();
  const DeviceSettings defaults = default_settings(device);
  DeviceSettings settings = defaults;
  settings.group_size = defaults.group_size == 16 ? 8 : 16;
  settings.polygon_lanes = 4;
  const auto opened = [&] { return settings_of(Device::choose(device.selector())); };
  const std::string file = settings_file(device);
  CHECK(opened() == defaults);
  CHECK_FALSE(remove_settings(device));
  save_settings(device, settings);
  {
    const Log log;
    CHECK(opened() == settings);
    CHECK(contains(log.text(), "from " + file));
  }
  CHECK(cl::lane_width(settings, 2) == 4);
  for (const std::string& text : {std::string(), std::string("\0\xff\n", 3),
                                  replaced(cl::settings_text(device, settings), "driver ", "driver x")}) {
    std::ofstream(file, std::ios::trunc) << text;
    const Log log;
    CHECK(opened() == defaults);
    CHECK(contains(log.text(), "are not taken from " + file + ": "));
    CHECK(contains(log.text(), "'powercell tune' measures them again"));
  }
  CHECK(remove_settings(device));
  CHECK_FALSE(fs::exists(file));
  fs::create_directory(file);
  CHECK(opened() == defaults);
}

TEST_CASE("settings are written whole or refused") {
  TemporaryFolder folder;
  std::ofstream(folder.path() / "taken") << "a file";
  const Environment cache("POWERCELL_CACHE_DIR", (folder.path() / "taken").string());
  const DeviceInfo device = some_device();
  CHECK_THROWS_WITH_AS(save_settings(device, others), doctest::Contains("cannot be written"), Error);
}
