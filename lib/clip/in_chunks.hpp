/// \file
/// Work in chunks that shrink when device memory runs out.
#pragma once

#include <algorithm>
#include <cstdint>
#include <powercell/error.hpp>
#include <string>

#include "lib/report/log.hpp"

namespace powercell {

struct ChunkSizes {
  std::uint64_t chunk;  ///< initial number of items of a chunk
  std::uint64_t least;  ///< smallest number of items of a chunk
  const char* items;    ///< e.g. "pairs", for the log
};

/// Calls body(begin, end) for consecutive ranges that cover [0, total). If a call runs out of device memory,
/// halves the chunk, calls free_memory() and repeats the range.
/// \pre a call that throws has no effect
/// \return the size of a chunk at the end
/// \throw Error out_of_device_memory if the smallest chunk does not fit
template <class Body, class FreeMemory>
std::uint64_t in_chunks(std::uint64_t total, ChunkSizes sizes, const Body& body,
                        const FreeMemory& free_memory) {
  std::uint64_t chunk = sizes.chunk;
  for (std::uint64_t begin = 0; begin < total;) {
    const std::uint64_t end = std::min(total, begin + chunk);
    try {
      body(begin, end);
      begin = end;
    } catch (const Error& error) {
      if (error.code() != ErrorCode::out_of_device_memory || chunk <= sizes.least) throw;
      chunk = std::max(sizes.least, chunk / 2);
      write_log(LogLevel::info, [&] {
        return "out of device memory; continuing with chunks of " + std::to_string(chunk) + " " + sizes.items;
      });
      free_memory();
    }
  }
  return chunk;
}

}  // namespace powercell
