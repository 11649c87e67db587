/// \file
/// Clips chunks of (region, seed) pairs on the device: rounds of candidates, the capacity ladder, and
/// the host for what rounding may have decided and as the last resort.
#pragma once

#include <map>
#include <optional>
#include <span>

#include "lib/clip/host_clip.hpp"
#include "lib/clip/pieces.hpp"
#include "lib/clip/row_reader.hpp"
#include "lib/neighbors/candidates.hpp"
#include "lib/scene/scene.hpp"

namespace powercell {

/// What clipping has done so far.
struct ClipStatistics {
  std::uint64_t retried = 0;    ///< pairs that went to a larger variant
  std::uint64_t on_host = 0;    ///< pairs that ended on the host
  std::uint64_t uncertain = 0;  ///< pairs that rounding may have decided
  int rounds = 0;               ///< most rounds of candidates that a chunk needed

  void add(const ClipStatistics& other);
};

struct ClipOptions {
  bool exact = true;  ///< pairs that rounding may have decided are decided on the host
  int threads = 1;    ///< of the host
};

/// What a Clipper reads from and writes to. The system hands out new memory page by page, which for some
/// thousand pairs takes a tenth of the time of clipping: whoever clips again can keep it.
struct ClipMemory {
  explicit ClipMemory(const std::shared_ptr<cl::Context>& context);
  std::size_t bytes() const;  ///< on the device

  cl::Buffer<std::uint32_t> active, seed, region, status, faces, vertices, link;
  cl::Buffer<std::int32_t> border;
  cl::RawBuffer moments, wall, vertex;
  PieceSet pieces;
};

class Clipper {
 public:
  /// \param outputs OUTPUT_... of kernels/layout.h
  /// \param memory  of an earlier one on the same device
  Clipper(const Scene& scene, Candidates& candidates, int outputs, ClipOptions options = {},
          std::optional<ClipMemory> memory = {});

  /// Its memory, for the next one. Nothing may be asked of this one any more.
  ClipMemory release() &&;

  /// Clips pair k = (pair_seed[k], pair_region[k]), ranks ascending. Afterwards every pair has a final
  /// status; moments() holds its moments in device memory, and the result, good until the next call, its rows
  /// where asked for.
  /// \throw Error opencl, out_of_device_memory, build_failed, internal
  const PieceSet& clip(std::span<const std::uint32_t> pair_seed, std::span<const std::uint32_t> pair_region);

  /// The same with rung `rung` of the capacity ladder alone: pairs that do not fit it keep PIECE_FULL or
  /// PIECE_TANGLED.
  const PieceSet& clip_with(std::size_t rung, std::span<const std::uint32_t> pair_seed,
                            std::span<const std::uint32_t> pair_region);

  /// Moments by pair of the last chunk: rows of 2 + dimension reals of the device's precision.
  const cl::RawBuffer& moments() const { return memory_.moments; }
  const ClipStatistics& statistics() const { return statistics_; }

 private:
  using List = std::vector<std::uint32_t>;
  struct Outcome {
    List more, full, tangled, uncertain;
  };

  cl::Kernel& kernel(std::size_t rung);
  std::size_t rows_that_fit(std::size_t rung) const;
  void launch(std::size_t rung, std::span<const std::uint32_t> active, int round, Outcome& outcome);
  /// Room for what the pairs of one launch leave.
  void reserve_rows(std::size_t rows, const Capacity& capacity);
  void read_rows(const Capacity& capacity, PieceBatch& batch);
  /// Before the next launch writes to where rows were taken from; those of this chunk are copied.
  void take_back_rows();
  /// Clips `active` with one rung until no pair asks for more candidates.
  void run_rung(std::size_t rung, const List& active, Outcome& outcome);
  /// Takes in the pairs of a chunk; returns all of them as pending.
  List begin(std::span<const std::uint32_t> pair_seed, std::span<const std::uint32_t> pair_region);
  /// Appends one row. Returns the status.
  int clip_on_host(HostClipper& host, std::uint32_t pair, std::span<double> moments, PieceBatch& rows) const;
  /// Clips `pairs`, ascending, on the host.
  void finish_on_host(const List& pairs);
  /// Rows of 2 + dimension moments, one for each of `pairs`, ascending.
  void write_moments(const List& pairs, std::span<const double> moments);
  bool wants_rows() const;

  const Scene& scene_;
  Candidates& candidates_;
  int outputs_;
  ClipOptions options_;
  std::map<std::size_t, cl::Kernel> kernels_;
  std::optional<HostScene> host_scene_;
  std::span<const std::uint32_t> pair_seed_, pair_region_;
  ClipStatistics statistics_;
  ClipMemory memory_;
  List launch_ranks_, launch_status_;
  std::optional<RowReader> reader_;
};

}  // namespace powercell
