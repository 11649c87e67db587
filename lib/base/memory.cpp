#include "lib/base/memory.hpp"

#include <algorithm>
#include <cstdint>

#include "lib/base/threads.hpp"

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace powercell {

void populate([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes,
              [[maybe_unused]] int threads) {
#if defined(__linux__) && defined(MADV_POPULATE_WRITE)
  constexpr std::size_t page = 4096;                // bytes; madvise refuses where pages are larger
  constexpr std::size_t least_bytes = 64 * page;    // fewer are not worth a call
  constexpr std::size_t least_shared = 256 * page;  // bytes per thread: fewer cost no more than starting one
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const std::size_t before = (page - address % page) % page;
  if (bytes < least_bytes + before) return;
  char* const first = static_cast<char*>(begin) + before;
  const std::size_t pages = (bytes - before) / page;
  const std::size_t workers = std::min<std::size_t>(pages * page / least_shared + 1, std::max(threads, 1));
  parallel_for(static_cast<int>(workers), pages, [&](std::size_t from, std::size_t to) {
    madvise(first + from * page, (to - from) * page, MADV_POPULATE_WRITE);  // a hint: may fail
  });
#endif
}

}  // namespace powercell
