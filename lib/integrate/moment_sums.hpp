/// \file
/// From the moments of pieces to the measures of cells, chunk after chunk.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <powercell/results.hpp>
#include <vector>

#include "lib/cl/program.hpp"
#include "lib/scene/domain_buffers.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// Sums on the device and finishes on the host what a chunk completes: memory by chunk, not by seed.
class MomentSums {
 public:
  /// Every seed starts as hidden, or as duplicate. Keeps references to all but `domain_measure`.
  MomentSums(const DomainBuffers& domain, const SeedSet& seeds, double domain_measure, int threads);

  /// Adds the pairs [begin, end), which are of the ranks [first, last]; the last one may go on in the next
  /// chunk, which begins with pair `end`. If this throws nothing has been added.
  /// \param pair_offset  per rank: its first pair, then the number of pairs
  /// \param moments      by pair of the chunk, in device memory
  void add(const std::vector<std::uint64_t>& pair_offset, std::uint64_t begin, std::uint64_t end,
           std::uint32_t first, std::uint32_t last, const cl::RawBuffer& moments);

  const std::vector<SeedStatus>& status() const { return measures_.status; }
  Measures finish() { return std::move(measures_); }

 private:
  /// One pair a rank, as where the domain is one region: sums are the moments as they are.
  static bool one_each(const std::vector<std::uint64_t>& pair_offset, std::uint64_t begin, std::uint64_t end,
                       std::uint32_t first, std::uint32_t last);
  void sum_on_device(const std::vector<std::uint64_t>& pair_offset, std::uint64_t begin, std::uint64_t end,
                     std::uint32_t first, std::uint32_t last, const cl::RawBuffer& moments);
  /// \param sums  rows of the ranks from `first` on
  void set_measures(std::uint32_t first, std::uint32_t last, const std::byte* sums);

  const DomainBuffers& domain_;
  const SeedSet& seeds_;
  int threads_;
  std::size_t columns_, row_bytes_;
  std::optional<cl::Kernel> gather_;  // where ranks have several pairs
  cl::Buffer<std::uint32_t> offset_;
  cl::RawBuffer before_, device_sums_;
  std::vector<std::uint32_t> chunk_offset_;
  std::vector<std::byte> open_;  // the row of the rank that goes on, in the device's precision
  Measures measures_;
};

}  // namespace powercell
