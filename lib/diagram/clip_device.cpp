#include "lib/diagram/clip_device.hpp"

#include <algorithm>
#include <utility>

#include "lib/cl/context.hpp"
#include "lib/cl/quirks.hpp"

namespace powercell {

ClipDevice::ClipDevice(const ClipWork& work, const Device& device, DeviceWorkspace& kept,
                       Candidates& candidates)
    : work_(work), device_(device), kept_(kept), candidates_(&candidates) {}

ClipDevice::ClipDevice(const ClipWork& work, const Device& device, DeviceWorkspace& kept,
                       const Candidates& first, std::unique_ptr<Candidates>& copy)
    : work_(work), device_(device), kept_(kept), first_(&first), copy_(&copy), candidates_(nullptr) {}

Scene ClipDevice::scene() const {
  return copy_ ? work_.active.scene_on(kept_.scene->domain, kept_.scene->seeds) : work_.active.scene();
}

void ClipDevice::prepare() {
  if (candidates_) return;
  use([&] {
    const Setup& setup = work_.setup;
    const Active& active = work_.active;
    if (!kept_.scene)
      kept_.scene = std::make_unique<DeviceScene>(device_.context(), setup.on_device.mesh(), setup.float32());
    if (kept_.scene->uploads != active.uploads()) {
      const int threads = std::max(1, setup.threads / static_cast<int>(setup.members.size()));
      kept_.scene->seeds.upload(setup.on_device.frame(), active.seeds(), active.tree(), threads);
      kept_.scene->uploads = active.uploads();
    }
    if (!*copy_) {
      const auto lock = cl::call_alone(setup.members.front().info());
      *copy_ = first_->on(scene());
    }
    candidates_ = copy_->get();
    chunks_[0].clipper.emplace(make_clipper(0));
    chunks_[0].clipper->build();
  });
}

Clipper ClipDevice::make_clipper(std::size_t chunk) {
  return Clipper(scene(), *candidates_, work_.outputs, work_.options,
                 std::exchange(kept_.clip[chunk], std::nullopt));
}

void ClipDevice::clip(ClipChunk& chunk) {
  if (!chunk.clipper) chunk.clipper.emplace(make_clipper(static_cast<std::size_t>(&chunk - chunks_.data())));
  use([&] { chunk.for_host = chunk.clipper->clip_on_device(chunk.pair_seed, chunk.pair_region); });
}

void ClipDevice::free_memory(ClipChunk& chunk) {
  chunk.clipper.reset();
  kept_.clip[static_cast<std::size_t>(&chunk - chunks_.data())].reset();
}

void ClipDevice::keep_memory() {
  for (std::size_t k = 0; k < chunks_.size(); ++k) {
    if (!chunks_[k].clipper) continue;
    ClipMemory memory = std::move(*chunks_[k].clipper).release();
    chunks_[k].clipper.reset();
    if (memory.bytes() <= kept_bytes) kept_.clip[k] = std::move(memory);
  }
}

void ClipChunk::set_pairs(const Plan& plan, std::uint64_t first, std::uint64_t last) {
  const std::vector<std::uint64_t>& offset = plan.pairs.offset;
  const auto row_of = [&](std::uint64_t pair) {
    return static_cast<std::uint32_t>(std::upper_bound(offset.begin(), offset.end(), pair) - offset.begin() -
                                      1);
  };
  begin = first;
  end = last;
  pair_row.resize(end - begin);
  for (std::uint32_t row = row_of(begin); row <= row_of(end - 1); ++row) {
    const std::uint64_t from = std::max(begin, offset[row]), to = std::min(end, offset[row + 1]);
    if (to > from) std::fill_n(&pair_row[from - begin], to - from, row);
  }
  set_seeds(plan);
  pair_region = std::span(plan.pairs.region).subspan(begin, end - begin);
}

void ClipChunk::set_seeds(const Plan& plan) {
  pair_seed = pair_row;
  if (!plan.selected) return;
  selected_seed.resize(pair_row.size());
  std::transform(pair_row.begin(), pair_row.end(), selected_seed.begin(),
                 [&](std::uint32_t row) { return plan.selected->rank[row]; });
  pair_seed = selected_seed;
}

namespace {

/// Vertices and faces of a chunk have 32-bit numbers, and a pair at most some 750 of them.
constexpr std::uint64_t most_chunk_pairs = std::uint64_t{1} << 22;

}  // namespace

std::uint64_t chunk_pairs(const Setup& setup, const Device& device, std::uint64_t total) {
  if (setup.options.chunk_pairs > 0) return std::min(setup.options.chunk_pairs, most_chunk_pairs);
  const std::uint64_t most =
      std::min(device.context()->settings().chunk_pairs, cl::quirks_of(device.info()).launch_limit);
  if (total == 0) return most;
  // Chunks of equal size, because a small last chunk would not keep all cores busy.
  return (total - 1) / ((total - 1) / most + 1) + 1;
}

}  // namespace powercell
