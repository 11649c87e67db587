#include "lib/diagram/chunk_pipeline.hpp"

#include <algorithm>
#include <limits>
#include <system_error>
#include <utility>

#include "lib/base/float_environment.hpp"
#include "lib/cl/context.hpp"
#include "lib/cl/quirks.hpp"
#include "lib/diagram/stopwatch.hpp"

namespace powercell {

ChunkPipeline::ChunkPipeline(std::deque<ClipDevice>& devices, const ClipPlan& plan, Sharing& sharing,
                             std::size_t chunks)
    : devices_(devices), plan_(plan), sharing_(sharing) {
  for (ClipDevice& device : devices_) {
    Lane& lane = lanes_.emplace_back();
    for (std::size_t k = 0; k < chunks; ++k) lane.slots.push_back({&device.chunks()[k]});
  }
}

ChunkPipeline::~ChunkPipeline() {
  {
    const std::scoped_lock lock(mutex_);
    stopped_ = true;
  }
  changed_.notify_all();
  for (Lane& lane : lanes_)
    if (lane.thread.joinable()) lane.thread.join();
}

bool ChunkPipeline::start() {
  bool any = false;
  for (std::size_t k = 0; k < lanes_.size(); ++k) {
    try {
      lanes_[k].thread = std::thread([this, k] { run(k); });
      any = true;
    } catch (const std::system_error&) {
      // The system refuses another thread: the other devices clip this one's share.
    }
  }
  return any;
}

void ChunkPipeline::run(std::size_t device) noexcept {
  const FloatEnvironment environment;  // where threads do not inherit it
  try {
    devices_[device].prepare();
    while (Slot* const slot = take(device)) clip(device, *slot);
  } catch (...) {
    const std::scoped_lock lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
    stopped_ = true;
  }
  changed_.notify_all();
}

ChunkPipeline::Slot* ChunkPipeline::usable(Lane& lane) {
  const auto is_free = [](const Slot& slot) { return slot.stage == Stage::free; };
  if (lane.one_at_a_time && !std::all_of(lane.slots.begin(), lane.slots.end(), is_free)) return nullptr;
  const auto found = std::find_if(lane.slots.begin(), lane.slots.end(), is_free);
  return found == lane.slots.end() ? nullptr : &*found;
}

ChunkPipeline::Slot* ChunkPipeline::take(std::size_t device) {
  std::unique_lock lock(mutex_);
  Slot* slot = nullptr;
  changed_.wait(lock, [&] { return stopped_ || (slot = usable(lanes_[device])) != nullptr; });
  if (stopped_) return nullptr;
  const Sharing::Range range = sharing_.take(device);
  if (range.empty()) return nullptr;
  slot->stage = Stage::taken;
  slot->chunk->begin = range.begin;
  slot->chunk->end = range.end;
  return slot;
}

void ChunkPipeline::clip(std::size_t device, Slot& slot) {
  ClipChunk& chunk = *slot.chunk;
  chunk.set_pairs(plan_, chunk.begin, chunk.end);
  const Stopwatch watch(devices_[device].device());
  bool is_clipped = true;
  try {
    devices_[device].clip(chunk);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::out_of_device_memory) throw;
    is_clipped = false;
  }
  {
    const std::scoped_lock lock(mutex_);
    if (is_clipped)
      sharing_.took(device, chunk.end - chunk.begin, watch.seconds());
    else
      lanes_[device].one_at_a_time = true;
    slot.is_clipped = is_clipped;
    slot.stage = Stage::done;
  }
  changed_.notify_all();
}

ChunkPipeline::Done ChunkPipeline::wait_for(std::uint64_t begin) {
  std::unique_lock lock(mutex_);
  for (;;) {
    if (failure_) std::rethrow_exception(failure_);
    for (std::size_t k = 0; k < lanes_.size(); ++k)
      for (const Slot& slot : lanes_[k].slots)
        if (slot.stage == Stage::done && slot.chunk->begin == begin) return {k, slot.chunk, slot.is_clipped};
    changed_.wait(lock);
  }
}

void ChunkPipeline::release(const Done& done) {
  {
    const std::scoped_lock lock(mutex_);
    for (Slot& slot : lanes_[done.device].slots)
      if (slot.chunk == done.chunk) slot.stage = Stage::free;
  }
  changed_.notify_all();
}

void ChunkPipeline::take_over(const Done& done) {
  std::unique_lock lock(mutex_);
  Lane& lane = lanes_[done.device];
  lane.one_at_a_time = true;
  changed_.wait(lock, [&] {
    return std::none_of(lane.slots.begin(), lane.slots.end(),
                        [](const Slot& slot) { return slot.stage == Stage::taken; });
  });
  for (Slot& slot : lane.slots) {
    slot.is_clipped = false;
    devices_[done.device].free_memory(*slot.chunk);
  }
}

void ChunkPipeline::limit(std::size_t device, std::uint64_t most) {
  const std::scoped_lock lock(mutex_);
  sharing_.limit(device, most);
}

namespace {

/// The first range of a member whose speed is not known has this part of its most items, and so have the
/// shortest ranges towards the end of what its speed allows.
constexpr std::uint64_t shortest_part = 8;

}  // namespace

Sharing::Sharing(std::uint64_t total, std::uint64_t least, const std::vector<Member>& members)
    : total_(total), least_(std::max<std::uint64_t>(least, 1)) {
  for (const Member& member : members) members_.push_back({member, false});
}

double Sharing::speed_of_others(std::size_t member) const {
  double sum = 0;
  for (std::size_t k = 0; k < members_.size(); ++k)
    if (k != member && members_[k].takes_part) sum += members_[k].speed;
  return sum;
}

std::uint64_t Sharing::size_for(std::size_t member) const {
  const State& own = members_[member];
  const std::uint64_t most = own.most;
  const double others = speed_of_others(member), left = static_cast<double>(total_ - next_);
  if (members_.size() == 1) return most;
  if (own.speed == 0)
    return std::clamp(std::min(most / shortest_part, (total_ - next_) / (4 * members_.size())),
                      std::min(least_, most), most);
  double seconds = std::numeric_limits<double>::infinity();  // of a range
  for (const State& each : members_)
    if (each.takes_part && each.speed > 0)
      seconds = std::min(seconds, static_cast<double>(each.most) / each.speed);
  const double longest = std::min(static_cast<double>(most), own.speed * seconds);
  // Half of what is due to this member, because speeds change.
  const double due = others > 0 ? left * own.speed / (own.speed + others) / 2 : left;
  const auto shortest =
      std::max<double>(static_cast<double>(least_), longest / static_cast<double>(shortest_part));
  return std::clamp<std::uint64_t>(static_cast<std::uint64_t>(std::max(shortest, std::min(longest, due))), 1,
                                   most);
}

Sharing::Range Sharing::take(std::size_t member) {
  State& own = members_[member];
  own.takes_part = true;
  const std::uint64_t size = std::min(size_for(member), total_ - next_);
  const double others = speed_of_others(member);
  const bool too_slow =
      own.speed > 0 && static_cast<double>(size) / own.speed > static_cast<double>(total_ - next_) / others;
  if (size == 0 || (others > 0 && too_slow)) {
    own.takes_part = false;
    return {};
  }
  const std::uint64_t begin = std::exchange(next_, next_ + size);
  return {begin, next_};
}

void Sharing::took(std::size_t member, std::uint64_t items, double seconds) {
  // So that a clock that did not move counts as fast, not as infinitely fast.
  const double measured = static_cast<double>(items) / std::max(seconds, 1e-9);
  double& speed = members_[member].speed;
  speed = speed == 0 ? measured : (speed + measured) / 2;
}

void Sharing::limit(std::size_t member, std::uint64_t most) {
  members_[member].most = std::max<std::uint64_t>(1, std::min(members_[member].most, most));
}

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
    const DiagramSetup& setup = work_.setup;
    const ActiveSeeds& active = work_.active;
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

void ClipChunk::set_pairs(const ClipPlan& plan, std::uint64_t first, std::uint64_t last) {
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

void ClipChunk::set_seeds(const ClipPlan& plan) {
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

std::uint64_t chunk_pairs(const DiagramSetup& setup, const Device& device, std::uint64_t total) {
  if (setup.options.chunk_pairs > 0) return std::min(setup.options.chunk_pairs, most_chunk_pairs);
  const std::uint64_t most =
      std::min(device.context()->settings().chunk_pairs, cl::quirks_of(device.info()).launch_limit);
  if (total == 0) return most;
  // Chunks of equal size, because a small last chunk would not keep all cores busy.
  return (total - 1) / ((total - 1) / most + 1) + 1;
}

}  // namespace powercell
