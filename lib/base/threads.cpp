#include "lib/base/threads.hpp"

#include <algorithm>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

#include "lib/base/float_environment.hpp"

namespace powercell {

int thread_count(int requested) {
  constexpr int most = 4096;  // more threads than this cost more than they do
  if (requested > 0) return std::min(requested, most);
  static const unsigned machine = std::thread::hardware_concurrency();  // reads a file; 0 where unknown
  return machine == 0 ? 1 : static_cast<int>(machine);
}

void run_workers(int workers, const std::function<void(int)>& worker) {
  if (workers <= 0) return;
  std::vector<std::exception_ptr> thrown(static_cast<std::size_t>(workers));
  const auto guarded = [&](int w) noexcept {
    const FloatEnvironment environment;  // where threads do not inherit it
    try {
      worker(w);
    } catch (...) {
      thrown[static_cast<std::size_t>(w)] = std::current_exception();
    }
  };
  std::vector<std::thread> started;
  started.reserve(static_cast<std::size_t>(workers));
  int next = 1;
  try {
    for (; next < workers; ++next) started.emplace_back(guarded, next);
  } catch (const std::system_error&) {
    // The system refuses more threads: the calling thread runs the remaining workers.
  }
  guarded(0);
  for (; next < workers; ++next) guarded(next);
  for (std::thread& thread : started) thread.join();
  for (const std::exception_ptr& exception : thrown)
    if (exception) std::rethrow_exception(exception);
}

}  // namespace powercell
