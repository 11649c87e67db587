/// \file
/// Clips chunks of (region, seed) pairs: on the device in rounds of candidates, with larger capacities for
/// pieces that do not fit, and on the host for pieces that rounding may have decided or that fit no capacity.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lib/cell/host_clip.hpp"
#include "lib/cell/pieces.hpp"
#include "lib/clip/row_reader.hpp"
#include "lib/neighbors/candidates.hpp"

namespace powercell {

struct ClipStatistics {
  std::uint64_t retried = 0;    ///< pairs clipped again with a larger capacity
  std::uint64_t on_host = 0;    ///< pairs finished on the host
  std::uint64_t uncertain = 0;  ///< pairs that rounding may have decided
  int rounds = 0;               ///< largest number of rounds of candidates of a chunk

  void add(const ClipStatistics& other);
};

struct ClipOptions {
  bool exact = true;  ///< clip pairs that rounding may have decided again on the host
  int threads = 1;    ///< of the host
  /// Pieces finished on the host are those of the weights with their infinitesimals (86): none is flat, and
  /// every face keeps its own plane. So all of them fit together, whatever seeds tie.
  bool perturbed = false;
  /// The number of pairs of the whole pass, if it is known. Of few pairs, those too large for the first
  /// capacity are finished on the host: compiling a larger program would take longer.
  std::uint64_t pairs = ~std::uint64_t{0};
  /// Read the moments at the end of clip_on_device(), so that the device can clip other pairs while the host
  /// finishes these: whatever it enqueues then waits for them.
  bool read_moments = false;
};

/// The buffers and pieces of a Clipper. A caller that clips again passes them on: to touch new memory page by
/// page takes a tenth of the time of clipping some thousand pairs.
struct ClipMemory {
  explicit ClipMemory(const std::shared_ptr<cl::Context>& context);
  std::size_t bytes() const;  ///< on the device

  cl::Buffer<std::uint32_t> active, seed, region, status, faces, vertices, link;
  cl::Buffer<std::int32_t> border;
  cl::RawBuffer moments, wall, vertex, reach;
  PieceSet pieces;
};

class Clipper {
 public:
  /// \param outputs  OUTPUT_... of kernels/layout.h
  /// \param memory   released by an earlier clipper on the same device
  Clipper(const Scene& scene, Candidates& candidates, int outputs, ClipOptions options = {},
          std::optional<ClipMemory> memory = {});

  /// The memory, for another clipper. This one must not be used any more.
  ClipMemory release() &&;

  /// Clips the pairs (pair_seed[k], pair_region[k]), ranks ascending. Afterwards moments() holds their
  /// moments in device memory.
  /// \return the final statuses and, if `outputs` has them, the rows; valid until the next call
  /// \throw Error opencl, out_of_device_memory, build_failed, self_test_failed, internal
  const PieceSet& clip(std::span<const std::uint32_t> pair_seed, std::span<const std::uint32_t> pair_region);

  /// Compiles the first kernel, which is else done when it is first needed.
  /// \throw Error build_failed, self_test_failed, opencl
  void build() { kernel(0); }

  /// The first step of clip().
  /// \return the pairs, ascending, that finish_on_host() must be called with
  std::vector<std::uint32_t> clip_on_device(std::span<const std::uint32_t> pair_seed,
                                            std::span<const std::uint32_t> pair_region);
  /// The second step of clip().
  const PieceSet& finish_on_host(const std::vector<std::uint32_t>& pairs);

  /// As clip(), with one of capacities() only and without the host: pairs that fail keep the status
  /// PIECE_FULL or PIECE_TANGLED.
  const PieceSet& clip_with(std::size_t capacity, std::span<const std::uint32_t> pair_seed,
                            std::span<const std::uint32_t> pair_region);

  /// The moments of the last chunk, by pair: rows of 2 + dimension reals of the device's precision. Writes
  /// those that the host has changed.
  const cl::RawBuffer& moments();
  /// The same on the host, where they have been read already; else null.
  const std::byte* moments_on_host() const { return moments_read_ ? host_moments_.data() : nullptr; }
  /// The scene for the host, made on first use.
  using SharedHostScene = std::shared_ptr<std::optional<HostScene>>;
  /// From now on uses one of several clippers, also on other devices. These must not finish chunks on the
  /// host at the same time.
  void share_host_scene(SharedHostScene scene) { host_scene_ = std::move(scene); }
  const ClipStatistics& statistics() const { return statistics_; }
  /// The statistics since the last call.
  ClipStatistics take_statistics() { return std::exchange(statistics_, {}); }

 private:
  using List = std::vector<std::uint32_t>;
  struct Outcome {
    List more, full, tangled, uncertain;
  };

  const Capacity& capacity(std::size_t number) const;
  cl::Kernel& kernel(std::size_t capacity);
  std::size_t rows_that_fit(std::size_t capacity) const;
  /// Uploads the pairs of a chunk and returns all of them, as pending.
  List begin_chunk(std::span<const std::uint32_t> pair_seed, std::span<const std::uint32_t> pair_region);
  /// Clips `active` with one capacity until no pair needs more candidates.
  void run(std::size_t capacity, const List& active, Outcome& outcome);
  void launch(std::size_t capacity, std::span<const std::uint32_t> active, int round, Outcome& outcome);
  /// Reads the statuses of a launch; of few pairs also the rows of walls and the moments, in one go.
  void read_launch(std::size_t rows, const Capacity& capacity);
  /// Sorts the pairs of a launch by their statuses: appends unfinished ones to `outcome`.
  void sort_statuses(std::span<const std::uint32_t> active, Outcome& outcome);
  /// Allocates the rows of one launch.
  void reserve_rows(std::size_t rows, const Capacity& capacity);
  void read_rows(const Capacity& capacity, PieceBatch& batch);
  void read_reach(std::span<const std::uint32_t> active);
  void read_moments();
  /// Copies the mapped rows of this chunk and unmaps them, before the next launch overwrites them.
  void unmap_rows();
  bool wants_rows() const;

  // clipper_host.cpp
  /// \param moments  rows of 2 + dimension for `pairs`, ascending
  void change_moments(const List& pairs, std::span<const double> moments);

  const Scene scene_;
  Candidates& candidates_;
  int outputs_;
  ClipOptions options_;
  std::map<std::size_t, cl::Kernel> kernels_;  // by number of the capacity
  SharedHostScene host_scene_ = std::make_shared<std::optional<HostScene>>();
  std::span<const std::uint32_t> pair_seed_, pair_region_;
  ClipStatistics statistics_;
  ClipMemory memory_;
  List launch_ranks_, launch_status_;
  std::vector<std::byte> host_moments_;
  bool moments_read_ = false, moments_changed_ = false;  // on the host
  std::optional<RowReader> reader_;
};

}  // namespace powercell
