#include "lib/cl/build_clock.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "lib/cl/context.hpp"

namespace powercell {
namespace {

std::atomic<int> running{0};
std::mutex mutex;  // guards `spent`
KernelBuilds spent;

}  // namespace

KernelBuilds kernel_builds() noexcept {
  const std::scoped_lock lock(mutex);
  KernelBuilds result = spent;
  result.running = running.load() > 0;
  return result;
}

namespace cl {

BuildClock::BuildClock() {
  ++running;
}
BuildClock::~BuildClock() {
  --running;
}

double BuildClock::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

double BuildClock::done(Context& context, double execution) const {
  const double all = seconds(), building = std::max(0.0, all - execution);
  const double processor = static_cast<double>(std::clock() - processor_start_) / CLOCKS_PER_SEC;
  context.add_build_seconds(building);
  const std::scoped_lock lock(mutex);
  spent.seconds += building;
  if (all > 0) spent.processor_seconds += processor * building / all;
  return building;
}

}  // namespace cl
}  // namespace powercell
