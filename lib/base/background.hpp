/// \file
/// Work on another thread while the caller goes on.
#pragma once

#include <cstddef>
#include <future>
#include <utility>

namespace powercell {

/// One task at a time on another thread. The destructor waits for the last one. Where the system gives no
/// thread, finish() runs it.
class BackgroundTask {
 public:
  BackgroundTask() = default;
  BackgroundTask(const BackgroundTask&) = delete;  // tasks may know what has it
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  /// Waits for the task before.
  /// \throw what that one threw
  template <class Task>
  void run(Task task) {
    finish();
    last_ = std::async(std::move(task));
  }
  /// Waits for the last task.
  /// \throw what that one threw
  void finish() {
    if (last_.valid()) last_.get();
  }

 private:
  std::future<void> last_;
};

/// Calls `use(make(k))` for k = 0 .. count-1, in this order, and makes the next item while one is used.
/// `use` may keep its item. Rethrows the first exception.
template <class Make, class Use>
void make_ahead(std::size_t count, const Make& make, const Use& use) {
  if (count == 0) return;
  auto next = std::async([&make] { return make(std::size_t{0}); });
  for (std::size_t k = 0; k < count; ++k) {
    auto item = next.get();
    if (k + 1 < count) next = std::async([&make, k] { return make(k + 1); });
    use(std::move(item));
  }
}

}  // namespace powercell
