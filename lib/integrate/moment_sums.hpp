/// \file
/// Sums the moments of pieces into the measures of cells, chunk by chunk.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/cl/program.hpp"
#include "lib/scene/domain_buffers.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// Makes the cell of seed i empty, and the seed hidden.
void clear_cell(Measures& measures, std::size_t i);

/// The moments of the pairs of a chunk.
struct PairMoments {
  const std::byte* on_host = nullptr;                    ///< null where they are on the device only
  std::function<const cl::RawBuffer&()> on_device = {};  ///< called where the host does not suffice
};

/// Sums on the device that clipped a chunk, or on the host if the moments are there, and converts the rows
/// that a chunk completes on the host, so device memory grows with the chunk and not with the number of
/// seeds.
class MomentSums {
 public:
  /// Every seed starts as hidden or duplicate. Keeps references to `domain` and `seeds`.
  MomentSums(const DomainBuffers& domain, const SeedSet& seeds, double domain_measure, int threads);

  /// Adds the pairs [begin, end), which belong to the ranks [first, last]. The last rank may have more pairs
  /// in the next chunk, which must begin with pair `end`. Adds nothing if it throws.
  /// \param pair_offset  per rank: its first pair; then the number of pairs
  /// \param moments      by pair of the chunk
  void add(const std::vector<std::uint64_t>& pair_offset, std::uint64_t begin, std::uint64_t end,
           std::uint32_t first, std::uint32_t last, const PairMoments& moments);

  /// Replaces the measures of ranks with one pair each. Replaces none if it throws.
  /// \param moments  by rank
  void replace(std::span<const std::uint32_t> ranks, const PairMoments& moments);

  /// Sets the measures of a rank without pairs.
  /// \param moments  2 + dimension, in device units
  void set(std::uint32_t rank, std::span<const double> moments);

  const std::vector<SeedStatus>& status() const { return measures_.status; }
  Measures finish() { return std::move(measures_); }

 private:
  /// Whether each rank has one pair, for instance in a domain of one region: the moments are then the sums.
  static bool one_pair_per_rank(const std::vector<std::uint64_t>& pair_offset, std::uint64_t begin,
                                std::uint64_t end, std::uint32_t first, std::uint32_t last);
  /// \return the sums
  const cl::RawBuffer& sum_on_device(const std::vector<std::uint64_t>& pair_offset, std::uint64_t begin,
                                     std::uint64_t end, std::uint32_t first, std::uint32_t last,
                                     const cl::RawBuffer& moments);
  /// The same on the host, where the moments are there.
  /// \return a row of sums for each rank
  const std::byte* sum_on_host(const std::vector<std::uint64_t>& pair_offset, std::uint64_t begin,
                               std::uint64_t end, std::uint32_t first, std::uint32_t last,
                               const std::byte* moments);
  /// A row of sums in the device's precision.
  std::array<double, 5> row_at(const std::byte* row) const;
  /// Sets the measures of the ranks [first, last).
  /// \param sums  a row for each rank
  void set_measures(std::uint32_t first, std::uint32_t last, const std::byte* sums);

  const DomainBuffers& domain_;
  const SeedSet& seeds_;
  int threads_;
  std::size_t columns_, row_bytes_;
  /// What one device sums with.
  struct Summing {
    std::optional<cl::Kernel> gather;  // built when a rank has several pairs
    cl::Buffer<std::uint32_t> offset;
    cl::RawBuffer before, sums;
    explicit Summing(const std::shared_ptr<cl::Context>& context)
        : offset(context), before(context), sums(context) {}
  };
  std::map<const cl::Context*, Summing> summing_;
  std::vector<std::uint32_t> chunk_offset_;
  std::vector<std::byte> host_sums_;
  std::vector<std::byte> open_;  // sum so far of a rank that continues, in the device's precision
  Measures measures_;
};

}  // namespace powercell
