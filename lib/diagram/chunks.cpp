#include "lib/diagram/chunks.hpp"

#include <algorithm>
#include <utility>

#include "kernels/layout.h"
#include "lib/base/threads.hpp"
#include "lib/diagram/stopwatch.hpp"
#include "lib/diagram/whole_cells.hpp"
#include "lib/report/log.hpp"

namespace powercell {

namespace {

/// Pairs in device memory at once, unless options say otherwise. A GPU needs many to be busy; the cores of a
/// CPU some groups each, and then what a chunk leaves behind is still in their caches when it is collected.
constexpr std::uint64_t chunk_pairs_gpu = std::uint64_t{1} << 18, chunk_pairs_core = std::uint64_t{1} << 14;
/// PoCL compiles a kernel once for less than 2^16 work-items and once for more: no chunk asks for both.
constexpr std::uint64_t chunk_pairs_cpu = (std::uint64_t{1} << 16) - 4096;
/// Where device memory does not suffice, chunks are halved down to this before the error is passed on.
constexpr std::uint64_t least_chunk_pairs = 1024;
/// Rows of vertices and faces within a chunk are numbered by 32 bits, at most some 750 to a pair.
constexpr std::uint64_t most_chunk_pairs = std::uint64_t{1} << 22;
/// Device memory for clipping, and memory for rows of walls, that a diagram keeps.
constexpr std::size_t kept_bytes = std::size_t{16} << 20;
/// Of a cell's largest wall, where decisions are fast: a one-sided wall below it is rounding.
constexpr double negligible_double = 1e-9, negligible_float = 1e-3;

}  // namespace

ChunkRun::ChunkRun(Diagram::State& state, bool want_adjacency, bool want_cells)
    : s_(state),
      want_adjacency_(want_adjacency),
      want_cells_(want_cells),
      outputs_(OUTPUT_MOMENTS | (want_adjacency ? OUTPUT_WALLS : 0) | (want_cells ? OUTPUT_GEOMETRY : 0)),
      measures_(state.scene, state.contenders(), state.domain.measure(), thread_count(state.options.threads)),
      walls_(want_adjacency ? state.contenders().size() : 0, thread_count(state.options.threads),
             std::exchange(state.wall_memory, {})),
      geometry_(state.domain.mesh(), state.contenders(), state.scene.frame()) {}

std::uint64_t ChunkRun::chunk_pairs() const {
  if (s_.options.chunk_pairs > 0) return std::min(s_.options.chunk_pairs, most_chunk_pairs);
  const DeviceInfo& device = s_.device.info();
  if (device.type != DeviceInfo::Type::cpu) return chunk_pairs_gpu;
  return std::min(chunk_pairs_cpu, std::max(1u, device.compute_units) * chunk_pairs_core);
}

std::uint32_t ChunkRun::rank_of(std::uint64_t pair) const {
  const auto& offset = s_.pairs.offset;
  return static_cast<std::uint32_t>(std::upper_bound(offset.begin(), offset.end(), pair) - offset.begin() -
                                    1);
}

void ChunkRun::clip_chunk(std::uint64_t begin, std::uint64_t end) {
  const Pairs& pairs = s_.pairs;
  const std::uint32_t first = rank_of(begin), last = rank_of(end - 1);
  pair_seed_.resize(end - begin);
  for (std::uint32_t rank = first; rank <= last; ++rank) {
    const std::uint64_t from = std::max(begin, pairs.offset[rank]),
                        to = std::min(end, pairs.offset[rank + 1]);
    if (to > from) std::fill_n(&pair_seed_[from - begin], to - from, rank);
  }
  const std::span pair_region(pairs.region.data() + begin, end - begin);
  const PieceSet& pieces = clipper_->clip(pair_seed_, pair_region);
  if (s_.options.decisions == Decisions::exact)
    for (std::size_t k = 0; k < pair_seed_.size(); ++k)
      if (pieces.status[k] == PIECE_FLAT) flat_.push_back(pair_seed_[k]);
  const double built_before = s_.device.build_seconds();
  Stopwatch watch;
  measures_.add(pairs.offset, begin, end, first, last, clipper_->moments());
  if (want_adjacency_) walls_.add(pair_seed_, pieces);
  if (want_cells_) geometry_.add(pair_seed_, pair_region, pieces);
  // Kernels whose first launch is here are compiled here, which is no part of any of the timings.
  collect_seconds_ += watch.seconds() - (s_.device.build_seconds() - built_before);
}

void ChunkRun::clip_all() {
  const std::uint64_t total = s_.pairs.region.size();
  const ClipOptions clip_options{s_.options.decisions == Decisions::exact, thread_count(s_.options.threads)};
  clipper_ = std::make_unique<Clipper>(s_.scene, *s_.candidates, outputs_, clip_options,
                                       std::exchange(s_.clip_memory, std::nullopt));
  const double neighbor_seconds = s_.candidates->host_seconds(), built_before = s_.device.build_seconds();
  ClipStatistics done;  // chunks of clippers that were given up
  Stopwatch watch;
  std::uint64_t chunk = chunk_pairs();
  // No last chunk of a few pairs, which the cores could not share well.
  if (s_.options.chunk_pairs == 0) chunk = (total - 1) / ((total - 1) / chunk + 1) + 1;
  for (std::uint64_t begin = 0; begin < total;) {
    const std::uint64_t end = std::min(total, begin + chunk);
    const ClipStatistics before = clipper_->statistics();
    try {
      clip_chunk(begin, end);
    } catch (const Error& error) {
      // Nothing of the chunk has been collected yet: smaller ones may fit.
      if (error.code() != ErrorCode::out_of_device_memory || chunk <= least_chunk_pairs) throw;
      chunk = std::max(least_chunk_pairs, chunk / 2);
      write_log(LogLevel::info, [&] {
        return "device memory does not suffice; chunks of " + std::to_string(chunk) + " pairs from now on";
      });
      done.add(before);
      clipper_ = std::make_unique<Clipper>(s_.scene, *s_.candidates, outputs_,
                                           clip_options);  // gives its buffers back
      continue;
    }
    write_log(LogLevel::detail,
              [&] { return std::to_string(end) + " of " + std::to_string(total) + " pairs clipped"; });
    begin = end;
    if (s_.options.progress && !s_.options.progress(static_cast<double>(end) / static_cast<double>(total)))
      throw Error(ErrorCode::interrupted, "the computation was stopped by its progress callback");
  }
  s_.timings.neighbors += s_.candidates->host_seconds() - neighbor_seconds;
  s_.timings.collect = collect_seconds_;
  s_.timings.clip = watch.seconds() - collect_seconds_ - (s_.candidates->host_seconds() - neighbor_seconds) -
                    (s_.device.build_seconds() - built_before);
  done.add(clipper_->statistics());
  s_.timings.retried = done.retried;
  s_.timings.on_host = done.on_host;
  s_.timings.uncertain = done.uncertain;
  s_.timings.rounds = done.rounds;
}

void ChunkRun::keep_wall_memory() {
  WallRows::Memory memory = std::move(walls_).release();
  std::size_t bytes = 0;
  for (const auto& words : memory) bytes += words.bytes();
  if (bytes <= kept_bytes) s_.wall_memory = std::move(memory);
}

std::vector<std::uint32_t> ChunkRun::run() {
  if (s_.contenders().size() > 0) clip_all();
  if (clipper_) {
    ClipMemory memory = std::move(*clipper_).release();
    clipper_.reset();
    // What follows needs memory, and so may others until the next time.
    if (memory.bytes() <= kept_bytes) s_.clip_memory = std::move(memory);
  }
  Stopwatch watch;
  Measures measures = measures_.finish();
  flat_.erase(std::unique(flat_.begin(), flat_.end()), flat_.end());
  std::erase_if(flat_, [&](std::uint32_t rank) { return measures.mass[s_.contenders().input[rank]] > 0; });
  if (!flat_.empty()) return {};
  if (s_.whole_cells && s_.contenders().size() > 0) {
    std::vector<std::uint32_t> unclear =
        settle_whole_cells(s_.domain.mesh(), *s_.finder, s_.pairs, s_.contenders(), s_.scene.float32(),
                           thread_count(s_.options.threads), measures);
    if (!unclear.empty()) return unclear;
  }
  if (want_adjacency_)
    s_.adjacency =
        walls_.finish(s_.contenders(), measures.status, s_.scene.frame().unit(s_.domain.cell_dimension() - 1),
                      s_.options.decisions == Decisions::exact ? 0
                      : s_.scene.float32()                     ? negligible_float
                                                               : negligible_double);
  keep_wall_memory();
  if (want_cells_) s_.cells = geometry_.finish(measures.status);
  // Those of whole cells stay when the geometry of their pieces is asked for.
  if (!s_.measures) s_.measures = std::move(measures);
  s_.timings.collect += watch.seconds();
  return {};
}

}  // namespace powercell
