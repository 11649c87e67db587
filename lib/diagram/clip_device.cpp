#include "lib/diagram/clip_device.hpp"

#include <algorithm>
#include <utility>

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

}  // namespace powercell
