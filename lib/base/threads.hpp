/// \file
/// Work shared between host threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>

namespace powercell {

/// Number of worker threads for an option value: `requested`, or those of the machine if it is 0 or less.
int thread_count(int requested);

/// Runs `worker(w)` for w = 0 .. workers-1 concurrently; worker 0 runs on the calling thread. Returns when
/// all have ended. Rethrows an exception of a worker (of several, that of the lowest w). Where the system
/// refuses a thread the calling thread runs that worker later, so workers must not wait for each other.
void run_workers(int workers, const std::function<void(int)>& worker);

/// `threads`, or 1 for fewer than `least_shared` items: starting a thread costs as much as thousands of items
/// of a few operations each.
inline int threads_for(std::size_t count, int threads, std::size_t least_shared = 32768) {
  return count < least_shared ? 1 : threads;
}

/// Calls `body(begin, end)` concurrently on contiguous ranges that cover [0, count), at most one per thread.
/// Rethrows the first exception.
template <class Body>
void parallel_for(int threads, std::size_t count, const Body& body) {
  const std::size_t ranges = std::min<std::size_t>(count, static_cast<std::size_t>(std::max(threads, 1)));
  if (ranges == 0) return;
  if (ranges == 1) return body(std::size_t{0}, count);
  run_workers(static_cast<int>(ranges), [&](int w) {
    const std::size_t k = static_cast<std::size_t>(w);
    body(count / ranges * k + std::min(k, count % ranges),
         count / ranges * (k + 1) + std::min(k + 1, count % ranges));
  });
}

/// Calls `body(worker, task)` for task = 0 .. tasks-1; a worker takes the next task when it is free, so tasks
/// may be of uneven length. After an exception no further task is begun; rethrows it.
template <class Body>
void parallel_tasks(int threads, std::size_t tasks, const Body& body) {
  const std::size_t workers = std::min<std::size_t>(tasks, static_cast<std::size_t>(std::max(threads, 1)));
  if (workers == 0) return;
  std::atomic<std::size_t> next{0};
  run_workers(static_cast<int>(workers), [&](int w) {
    try {
      for (std::size_t t = next++; t < tasks; t = next++) body(w, t);
    } catch (...) {
      next = tasks;
      throw;
    }
  });
}

/// The least k < count with `holds(k)`, or `count`. Calls `holds`, of a few operations, concurrently.
template <class Predicate>
std::size_t first_of(std::size_t count, int threads, const Predicate& holds) {
  std::atomic<std::size_t> first{count};
  parallel_for(threads_for(count, threads), count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      if (!holds(k)) continue;
      std::size_t known = first.load();
      while (k < known && !first.compare_exchange_weak(known, k)) {
      }
      return;
    }
  });
  return first.load();
}

}  // namespace powercell
