// What a device reaches and what the machine did meanwhile: shown, and in records.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/bench/table.hpp"
#include "tests/writers/temporary_folder.hpp"

using namespace powercell;
using namespace powercell::app;

namespace {

BenchDevice made_device() {
  BenchDevice measured;
  measured.latencies = {1e-6, 2e-6, 0.25, 0.5};
  measured.rates = {{"double", {1e10, 2e10, 0.125, 0}}};
  measured.transfers = {{4096, {1e8, 2e8, 0, 0.5}}, {16384, {4e8, 5e8, 0, 0.5}}};
  return measured;
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

}  // namespace

TEST_CASE("rates of a device are listed with their scatter") {
  const std::string text = device_lines(made_device());
  for (const char* part : {"a launch takes 1.0 us ±25 %, a transfer 2.0 us ±50 %\n",
                           "double: 10.0 GB/s copied ±12 %, 20.0 Gflop/s multiplied and added ±0 %\n",
                           "4 KiB             0.1   ±0 %           0.2  ±50 %\n"})
    CHECK_MESSAGE(text.find(part) != std::string::npos, text);
}

TEST_CASE("clock and load are those that the system tells, and nothing where it does not") {
  const test::TemporaryFolder folder;
  const std::filesystem::path root = folder.path();
  const HostState unknown = host_state(root);
  CHECK(unknown.load.empty());
  CHECK(unknown.clock_mhz.empty());
  CHECK(!unknown.busy);
  CHECK(!used_by_others(unknown, unknown));
  write(root / "proc/loadavg", "0.50 1.25 2.00 3/456 7890\n");
  write(root / "proc/stat", "cpu  100 200 300 9999 8888 400 500 600 77 66\ncpu0 1 2\n");
  write(root / "sys/devices/system/cpu/cpu0/cpufreq/scaling_cur_freq", "2400000\n");
  write(root / "sys/devices/system/cpu/cpu1/cpufreq/scaling_cur_freq", "3600000\n");
  const HostState known = host_state(root);
  CHECK(known.load == std::vector<double>{0.5, 1.25, 2});
  CHECK(known.clock_mhz == std::vector<double>{2400, 3600});
  REQUIRE(known.busy);
  CHECK(*known.busy == doctest::Approx(21));  // 2,100 ticks of a hundredth of a second
  CHECK(known.own > 0);

  BenchRecord record;
  record.devices = {made_device()};
  record.rows.resize(1);
  record.before = known;
  const nlohmann::json json = as_json(record);
  CHECK(json["state_before"]["load_averages"][1] == 1.25);
  CHECK(json["state_before"]["clock_mhz"]["least"] == 2400);
  CHECK(json["state_before"]["clock_mhz"]["mean"] == 3000);
  CHECK(json["state_before"]["clock_mhz"]["most"] == 3600);
  CHECK(json["state_after"] == nlohmann::json::object());
  CHECK(json["rows"][0]["state"] == nlohmann::json::object());
  CHECK(json["devices"][0]["rates"][0]["copied_scatter"] == 0.125);
  CHECK(json["devices"][0]["transfers"][1]["to_host_bytes_per_second"] == 5e8);
}

TEST_CASE("what others used is what was used and not by this process") {
  HostState before, after;
  before.busy = 100;
  before.own = 3;
  before.seconds = 50;
  after.busy = 130;
  after.own = 8;
  after.seconds = 60;
  CHECK(*used_by_others(before, after) == doctest::Approx(2.5));
  after.own = 40;  // ticks are coarser than the clock of a process
  CHECK(*used_by_others(before, after) == 0);
}
