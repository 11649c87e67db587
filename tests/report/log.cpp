// The log: silent without a sink, one line at a time, and independent of what the sink does.
#include <doctest/doctest.h>
#include <powercell.h>

#include <cstdlib>
#include <mutex>
#include <powercell/powercell.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using namespace powercell;

namespace {

struct Line {
  LogLevel level;
  std::string text;
};

/// Collects the lines of the log during its lifetime.
struct Listener {
  std::vector<Line> lines;
  explicit Listener(LogLevel most) {
    set_log(
        [this](LogLevel level, std::string_view line) {
          lines.push_back({level, std::string(line)});
        },
        most);
  }
  ~Listener() { set_log({}); }
  std::size_t count(const std::string& part) const {
    std::size_t found = 0;
    for (const Line& line : lines) found += line.text.find(part) != std::string::npos;
    return found;
  }
};

const Device& device() {
  static const auto* device = new Device(Device::choose());
  return *device;
}

Domain unit_square() {
  const std::vector<double> low = {0, 0}, high = {1, 1};
  return Domain::box(low, high);
}

const std::vector<double> positions = {0.25, 0.25, 0.75, 0.25, 0.25, 0.75, 0.8, 0.7};

double total_mass() {
  const Measures measures = measure(device(), unit_square(), {2, positions, {}});
  double sum = 0;
  for (const double mass : measures.mass) sum += mass;
  return sum;
}

}  // namespace

TEST_CASE("each computation is logged with its number of seeds, chunks only as details") {
  total_mass();  // builds the kernels
  {
    const Listener listener(LogLevel::info);
    total_mass();
    CHECK(listener.count("4 seeds, 4 pairs in ") == 1);
    for (const Line& line : listener.lines) {
      CHECK(line.level == LogLevel::info);
      CHECK(line.text.find('\n') == std::string::npos);
    }
  }
  const Listener listener(LogLevel::detail);
  total_mass();
  CHECK(listener.count("4 seeds, 4 pairs in ") == 1);
  CHECK(listener.count("4 of 4 pairs clipped") == 1);
}

TEST_CASE("pieces that the host finishes are logged") {
  const Listener listener(LogLevel::detail);
  const std::vector<double> grid = {0.25, 0.25, 0.75, 0.25, 0.25, 0.75, 0.75, 0.75};
  measure(device(), unit_square(), {2, grid, {}});
  CHECK(listener.count("pieces finished on the host: 4") == 2);  // when it happens, and in the summary
}

TEST_CASE("new devices and their programs are logged") {
  const Listener listener(LogLevel::detail);
  const Device fresh = Device::choose();
  CHECK(listener.count("device " + fresh.info().selector() + ": " + fresh.info().name) == 1);
  const double corners[] = {0, 0, 0,
                            1, 1, 1};  // with programs that no other case has, since devices share them
  measure(fresh, Domain::periodic_box(std::span(corners).first(3), std::span(corners).last(3)),
          {3, std::span(positions).first(6), {}});
  CHECK(listener.count("kernels/clip/by_tree.cl") >= 1);
}

TEST_CASE("nothing is logged without a sink, and a sink that throws has no effect") {
  std::vector<std::string> lines;
  set_log([&](LogLevel, std::string_view line) { lines.emplace_back(line); });
  set_log({});
  CHECK(total_mass() == doctest::Approx(1).epsilon(1e-14));
  CHECK(lines.empty());
  std::size_t called = 0;
  set_log([&](LogLevel, std::string_view) {
    ++called;
    throw std::runtime_error("the disk is full");
  });
  CHECK(total_mass() == doctest::Approx(1).epsilon(1e-14));
  set_log({});
  CHECK(called > 0);
}

TEST_CASE("lines of several threads are written one at a time") {
  const Listener listener(LogLevel::info);
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k) threads.emplace_back([] { total_mass(); });
  for (std::thread& thread : threads) thread.join();
  CHECK(listener.count("4 seeds, 4 pairs in ") == 4);
}

TEST_CASE("the C interface sends lines to its sink and refuses invalid levels") {
  std::vector<std::string> lines;
  const pc_log_sink sink = [](pc_log_level, const char* line, void* user) {
    static_cast<std::vector<std::string>*>(user)->emplace_back(line);
  };
  REQUIRE(pc_set_log(sink, PC_LOG_INFO, &lines) == PC_OK);
  CHECK(pc_set_log(sink, static_cast<pc_log_level>(7), &lines) == PC_INVALID_ARGUMENT);
  total_mass();
  REQUIRE(pc_set_log(nullptr, PC_LOG_INFO, nullptr) == PC_OK);
  const std::size_t before = lines.size();
  CHECK(before >= 1);
  total_mass();
  CHECK(lines.size() == before);
}
