#include "lib/diagram/chunks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/layout.h"
#include "lib/diagram/stopwatch.hpp"

namespace powercell {

namespace {

/// Pairs in device memory at once, unless options say otherwise.
constexpr std::uint64_t default_chunk_pairs = std::uint64_t{1} << 18;
/// Where device memory does not suffice, chunks are halved down to this before the error is passed on.
constexpr std::uint64_t least_chunk_pairs = 1024;
/// Of a cell's largest wall: a one-sided wall below it is rounding (docs/mathematics.md).
constexpr double negligible_double = 1e-9, negligible_float = 1e-3;

}  // namespace

ChunkRun::ChunkRun(Diagram::State& state, bool want_adjacency, bool want_cells)
    : s_(state),
      want_adjacency_(want_adjacency),
      want_cells_(want_cells),
      outputs_(OUTPUT_MOMENTS | (want_adjacency ? OUTPUT_WALLS : 0) | (want_cells ? OUTPUT_GEOMETRY : 0)),
      sums_(state.device.context()),
      offset_(state.device.context()),
      clear_(state.device.context()),
      walls_(state.seeds.size(), thread_count(state.options.threads)),
      geometry_(state.domain.mesh(), state.seeds, state.scene.frame()) {}

std::uint64_t ChunkRun::chunk_pairs() const {
  return s_.options.chunk_pairs > 0 ? s_.options.chunk_pairs : default_chunk_pairs;
}

std::uint32_t ChunkRun::rank_of(std::uint64_t pair) const {
  const auto& offset = s_.pairs.offset;
  return static_cast<std::uint32_t>(std::upper_bound(offset.begin(), offset.end(), pair) - offset.begin() -
                                    1);
}

void ChunkRun::gather(std::uint64_t begin, std::uint64_t end, std::uint32_t first_rank,
                      std::uint32_t last_rank) {
  std::vector<std::uint32_t> offset{0}, clear;
  for (std::uint32_t rank = first_rank; rank <= last_rank; ++rank) {
    offset.push_back(static_cast<std::uint32_t>(std::min(s_.pairs.offset[rank + 1], end) - begin));
    clear.push_back(s_.pairs.offset[rank] >= begin ? 1 : 0);
  }
  offset_.upload(offset);
  clear_.upload(clear);
  if (!gather_kernel_) {
    Variant variant;
    variant.dimension = s_.domain.dimension();
    variant.cell_dimension = s_.domain.cell_dimension();
    variant.float32 = s_.scene.float32();
    variant.capacity = {1, 1};
    auto program = s_.device.context()->program("integrate/gather.cl", variant.defines());
    gather_kernel_ = std::make_unique<cl::Kernel>(s_.device.context(), std::move(program), "gather");
  }
  gather_kernel_->args(static_cast<cl_uint>(clear.size()), static_cast<cl_uint>(first_rank), offset_, clear_,
                       clipper_->moments(), sums_);
  gather_kernel_->launch(clear.size());
}

void ChunkRun::clip_chunk(std::uint64_t begin, std::uint64_t end) {
  const Pairs& pairs = s_.pairs;
  const std::uint32_t first = rank_of(begin), last = rank_of(end - 1);
  std::vector<std::uint32_t> pair_seed;
  pair_seed.reserve(end - begin);
  for (std::uint32_t rank = first; rank <= last; ++rank) {
    const std::uint64_t from = std::max(begin, pairs.offset[rank]),
                        to = std::min(end, pairs.offset[rank + 1]);
    pair_seed.insert(pair_seed.end(), to > from ? to - from : 0, rank);
  }
  const std::span pair_region(pairs.region.data() + begin, end - begin);
  const PieceSet pieces = clipper_->clip(pair_seed, pair_region);
  gather(begin, end, first, last);
  Stopwatch watch;
  if (want_adjacency_) walls_.add(pair_seed, pieces);
  if (want_cells_) geometry_.add(pair_seed, pair_region, pieces);
  collect_seconds_ += watch.seconds();
}

void ChunkRun::clip_all() {
  const std::uint64_t total = s_.pairs.region.size();
  clipper_ = std::make_unique<Clipper>(s_.scene, *s_.candidates, outputs_);
  const double neighbor_seconds = s_.candidates->host_seconds(), built_before = s_.device.build_seconds();
  Stopwatch watch;
  std::uint64_t chunk = chunk_pairs();
  for (std::uint64_t begin = 0; begin < total;) {
    const std::uint64_t end = std::min(total, begin + chunk);
    try {
      clip_chunk(begin, end);
    } catch (const Error& error) {
      // Nothing of the chunk has been collected yet: smaller ones may fit.
      if (error.code() != ErrorCode::out_of_device_memory || chunk <= least_chunk_pairs) throw;
      chunk = std::max(least_chunk_pairs, chunk / 2);
      clipper_ = std::make_unique<Clipper>(s_.scene, *s_.candidates, outputs_);  // gives its buffers back
      continue;
    }
    begin = end;
    if (s_.options.progress && !s_.options.progress(static_cast<double>(end) / static_cast<double>(total)))
      throw Error(ErrorCode::interrupted, "the computation was stopped by its progress callback");
  }
  s_.timings.neighbors += s_.candidates->host_seconds() - neighbor_seconds;
  s_.timings.collect = collect_seconds_;
  s_.timings.clip = watch.seconds() - collect_seconds_ - (s_.candidates->host_seconds() - neighbor_seconds) -
                    (s_.device.build_seconds() - built_before);
  s_.timings.retried = clipper_->statistics().retried;
  s_.timings.on_host = clipper_->statistics().on_host;
  s_.timings.rounds = clipper_->statistics().rounds;
}

std::vector<double> ChunkRun::read_sums() const {
  const std::size_t count = s_.seeds.size() * (2 + static_cast<std::size_t>(s_.domain.dimension()));
  std::vector<double> sums(count);
  if (count == 0) return sums;
  if (s_.scene.float32()) {
    std::vector<float> narrow(count);
    sums_.read(narrow.data(), count * sizeof(float));
    std::copy(narrow.begin(), narrow.end(), sums.begin());
  } else {
    sums_.read(sums.data(), count * sizeof(double));
  }
  return sums;
}

Measures ChunkRun::make_measures() const {
  const auto d = static_cast<std::size_t>(s_.domain.dimension());
  const int k = s_.domain.cell_dimension();
  const Frame& frame = s_.scene.frame();
  const std::size_t n = s_.seeds.input_count;
  Measures m;
  m.dimension = s_.domain.dimension();
  m.domain_measure = s_.domain.measure();
  m.mass.assign(n, 0.0);
  m.centroid.assign(n * d, std::numeric_limits<double>::quiet_NaN());
  m.second_moment.assign(n, 0.0);
  m.status.assign(n, SeedStatus::hidden);
  for (const std::uint32_t i : s_.seeds.duplicate) m.status[i] = SeedStatus::duplicate;
  const std::vector<double> sums = read_sums();
  for (std::size_t rank = 0; rank < s_.seeds.size(); ++rank) {
    const double* sum = &sums[rank * (2 + d)];
    if (!(sum[0] > 0)) continue;
    const std::size_t i = s_.seeds.input[rank];
    m.status[i] = SeedStatus::ok;
    m.mass[i] = sum[0] * frame.unit(k);
    for (std::size_t c = 0; c < d; ++c)
      m.centroid[i * d + c] = s_.seeds.positions[rank * d + c] + sum[1 + c] / sum[0] / frame.scale;
    m.second_moment[i] = sum[1 + d] * frame.unit(k + 2);
  }
  return m;
}

void ChunkRun::run() {
  const std::size_t ranks = s_.seeds.size(), d = static_cast<std::size_t>(s_.domain.dimension());
  const std::size_t bytes = ranks * (2 + d) * (s_.scene.float32() ? sizeof(float) : sizeof(double));
  sums_.reserve(bytes);
  if (bytes > 0) sums_.fill_zero(bytes);
  if (ranks > 0) clip_all();
  Stopwatch watch;
  Measures measures = make_measures();
  if (want_adjacency_)
    s_.adjacency =
        walls_.finish(s_.seeds, measures.status, s_.scene.frame().unit(s_.domain.cell_dimension() - 1),
                      s_.scene.float32() ? negligible_float : negligible_double);
  if (want_cells_) s_.cells = geometry_.finish(measures.status);
  s_.measures = std::move(measures);
  s_.timings.collect += watch.seconds();
}

}  // namespace powercell
