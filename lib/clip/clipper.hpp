/// \file
/// Clips chunks of (region, seed) pairs: on the device in rounds of candidates, with larger capacities for
/// what does not fit, and on the host where rounding may have decided and as the last resort.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "lib/clip/host_clip.hpp"
#include "lib/clip/pieces.hpp"
#include "lib/clip/row_reader.hpp"
#include "lib/neighbors/candidates.hpp"

namespace powercell {

struct ClipStatistics {
  std::uint64_t retried = 0;    ///< pairs that were clipped again with a larger capacity
  std::uint64_t on_host = 0;    ///< pairs that ended on the host
  std::uint64_t uncertain = 0;  ///< pairs that rounding may have decided
  int rounds = 0;               ///< most rounds of candidates that a chunk needed

  void add(const ClipStatistics& other);
};

struct ClipOptions {
  bool exact = true;  ///< pairs that rounding may have decided are decided on the host
  int threads = 1;    ///< of the host
};

/// The buffers of a Clipper, and its pieces. The system hands out new memory page by page, which takes a
/// tenth of the time of clipping some thousand pairs, so a caller that clips again keeps it.
struct ClipMemory {
  explicit ClipMemory(const std::shared_ptr<cl::Context>& context);
  std::size_t bytes() const;  ///< on the device

  cl::Buffer<std::uint32_t> active, seed, region, status, faces, vertices, link;
  cl::Buffer<std::int32_t> border;
  cl::RawBuffer moments, wall, vertex;
  PieceSet pieces;
};

/// A pair whose piece is the union of its pieces in several regions. The device clipped it by planes of the
/// boundary, which the host does not have.
struct SplitPair {
  std::uint32_t pair;
  std::vector<std::uint32_t> regions;
};

class Clipper {
 public:
  /// \param outputs OUTPUT_... of kernels/layout.h
  /// \param memory  of an earlier one on the same device
  Clipper(const Scene& scene, Candidates& candidates, int outputs, ClipOptions options = {},
          std::optional<ClipMemory> memory = {});

  /// Its memory, for the next one. This one must not be used any more.
  ClipMemory release() &&;

  /// Clips pair k = (pair_seed[k], pair_region[k]), ranks ascending. Afterwards every pair has a final
  /// status; moments() holds its moments in device memory, and the result, valid until the next call, its
  /// rows where they were asked for. \throw Error opencl, out_of_device_memory, build_failed, internal
  const PieceSet& clip(std::span<const std::uint32_t> pair_seed, std::span<const std::uint32_t> pair_region);

  /// The two halves of clip(), for callers with pairs of several regions: the first returns the pairs,
  /// ascending, that finish_on_host() has to be called for.
  std::vector<std::uint32_t> clip_on_device(std::span<const std::uint32_t> pair_seed,
                                            std::span<const std::uint32_t> pair_region);
  /// \param split  ascending: those of `pairs` that have several regions
  const PieceSet& finish_on_host(const std::vector<std::uint32_t>& pairs,
                                 std::span<const SplitPair> split = {});

  /// As clip(), with number `capacity` of capacities() alone and without the host: pairs that do not fit keep
  /// PIECE_FULL or PIECE_TANGLED.
  const PieceSet& clip_with(std::size_t capacity, std::span<const std::uint32_t> pair_seed,
                            std::span<const std::uint32_t> pair_region);

  /// Moments by pair of the last chunk: rows of 2 + dimension reals of the device's precision.
  const cl::RawBuffer& moments() const { return memory_.moments; }
  const ClipStatistics& statistics() const { return statistics_; }

 private:
  using List = std::vector<std::uint32_t>;
  struct Outcome {
    List more, full, tangled, uncertain;
  };

  const Capacity& capacity(std::size_t number) const;
  cl::Kernel& kernel(std::size_t capacity);
  std::size_t rows_that_fit(std::size_t capacity) const;
  /// Takes in the pairs of a chunk; returns all of them as pending.
  List begin_chunk(std::span<const std::uint32_t> pair_seed, std::span<const std::uint32_t> pair_region);
  /// Clips `active` with one capacity until no pair asks for more candidates.
  void run(std::size_t capacity, const List& active, Outcome& outcome);
  void launch(std::size_t capacity, std::span<const std::uint32_t> active, int round, Outcome& outcome);
  /// Reads the statuses of a launch and sorts its pairs by what they need.
  void read_statuses(std::span<const std::uint32_t> active, Outcome& outcome);
  /// Makes room for the rows of one launch.
  void reserve_rows(std::size_t rows, const Capacity& capacity);
  void read_rows(const Capacity& capacity, PieceBatch& batch);
  /// Copies the rows of this chunk that lie in device memory, before the next launch overwrites them.
  void unmap_rows();
  bool wants_rows() const;

  // clipper_host.cpp
  /// Appends one row. Returns the status.
  int clip_on_host(HostClipper& host, std::uint32_t pair, const SplitPair* split, std::span<double> moments,
                   PieceBatch& rows) const;
  int clip_split(HostClipper& host, const SplitPair& split, std::span<double> moments,
                 PieceBatch& rows) const;
  /// \param moments  rows of 2 + dimension, one for each of `pairs`, ascending
  void write_moments(const List& pairs, std::span<const double> moments);

  const Scene scene_;
  Candidates& candidates_;
  int outputs_;
  ClipOptions options_;
  std::map<std::size_t, cl::Kernel> kernels_;  // by number of the capacity
  std::optional<HostScene> host_scene_;
  std::span<const std::uint32_t> pair_seed_, pair_region_;
  ClipStatistics statistics_;
  ClipMemory memory_;
  List launch_ranks_, launch_status_;
  std::optional<RowReader> reader_;
};

}  // namespace powercell
