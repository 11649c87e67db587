// Which setting of a device is chosen, from runs as they may scatter.
#include <doctest/doctest.h>

#include "apps/tune/choice.hpp"
#include "apps/tune/settings.hpp"

using namespace powercell;
using namespace powercell::app;

namespace {

TimedRuns runs(std::vector<double> seconds) {
  TimedRuns result;
  result.seconds = std::move(seconds);
  return result;
}

}  // namespace

TEST_CASE("a setting is chosen that is faster beyond the spread") {
  const Trial now{32, {runs({1.0, 1.01, 1.02}), runs({2.0, 2.0, 2.0})}, {}};
  const Trial faster{64, {runs({0.9, 0.91, 0.9}), runs({2.0, 2.0, 2.0})}, {}};
  const Trial fastest{128, {runs({0.8, 0.81, 0.8}), runs({1.9, 1.9, 1.9})}, {}};
  CHECK(best_trial({now, faster}) == 1);
  CHECK(best_trial({now, faster, fastest}) == 2);
  CHECK(best_trial({now, fastest, faster}) == 1);
  CHECK(best_trial({now}) == 0);
}

TEST_CASE("a difference within the scatter of either runs decides nothing") {
  const Trial now{32, {runs({1.0, 1.01, 1.02})}, {}};
  CHECK(best_trial({now, {64, {runs({0.98, 0.98, 0.98})}, {}}}) == 0);
  CHECK(best_trial({now, {64, {runs({0.9, 1.05, 1.1})}, {}}}) == 0);
  const Trial scattered{32, {runs({1.0, 1.3, 1.4})}, {}};
  CHECK(best_trial({scattered, {64, {runs({0.8, 0.8, 0.8})}, {}}}) == 0);
  CHECK(spread(scattered.runs[0], now.runs[0]) == doctest::Approx(0.31));
}

TEST_CASE("a setting that is slower in one job, or cannot run, is not chosen") {
  const Trial now{8, {runs({1.0, 1.0}), runs({1.0, 1.0})}, {}};
  CHECK(best_trial({now, {4, {runs({0.5, 0.5}), runs({1.1, 1.1})}, {}}}) == 0);
  CHECK(best_trial({now, {4, {runs({0.5, 0.5}), runs({1.02, 1.02})}, {}}}) == 1);
  CHECK(best_trial({now, {4, {runs({}), runs({})}, "no room"}}) == 0);
}

TEST_CASE("every setting is tried beside the one in use, within its range") {
  CHECK(setting_names() == std::vector<std::string>{"polygon_lanes", "polyhedron_lanes", "group_size",
                                                    "chunk_pairs", "launch_pairs"});
  for (const Setting& one : all_settings()) {
    DeviceSettings settings;
    const std::uint64_t now = one.get(settings);
    for (const std::uint64_t value : one.values(now)) {
      CHECK(value != now);
      one.set(settings, value);
      CHECK(one.get(settings) == value);
    }
    CHECK(one.values(now).size() >= 2);
  }
  CHECK(setting("group_size").values(1) == std::vector<std::uint64_t>{2, 4});
  CHECK(setting("chunk_pairs").values(2048) == std::vector<std::uint64_t>{1024, 4096, 8192});
}
