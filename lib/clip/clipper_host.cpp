// The host's part of a Clipper: pairs that rounding may have decided, and those that fit no capacity.
#include <algorithm>
#include <limits>
#include <type_traits>

#include "kernels/layout.h"
#include "lib/base/threads.hpp"
#include "lib/clip/clipper.hpp"
#include "lib/report/log.hpp"

namespace powercell {
namespace {

/// Pairs of one parallel task.
constexpr std::size_t pairs_of_task = 64;

}  // namespace

const cl::RawBuffer& Clipper::moments() {
  if (moments_changed_) memory_.moments.write(host_moments_.data(), host_moments_.size());
  moments_changed_ = false;
  return memory_.moments;
}

void Clipper::change_moments(const List& pairs, std::span<const double> moments) {
  const std::size_t count = 2 + static_cast<std::size_t>(scene_.mesh().dimension);
  const std::size_t first = moments_read_ ? 0 : pairs.front(), rows = pairs.back() + 1 - first;
  const auto patch = [&]<class Real>(Real* all) {
    // A measure above 0 marks a non-empty cell. In single precision, where devices may flush numbers below
    // 2^-126 to 0, tiny measures are raised, and the other moments with them.
    constexpr double least = std::is_same_v<Real, float> ? 0x1p-100 : std::numeric_limits<double>::min();
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const double measure = moments[k * count],
                   factor = measure > 0 && measure < least ? least / measure : 1;
      for (std::size_t m = 0; m < count; ++m)
        all[(pairs[k] - first) * count + m] = static_cast<Real>(factor * moments[k * count + m]);
    }
  };
  const auto patch_bytes = [&](std::byte* all) {
    scene_.float32() ? patch(reinterpret_cast<float*>(all)) : patch(reinterpret_cast<double*>(all));
  };
  if (moments_read_) {
    patch_bytes(host_moments_.data());
    moments_changed_ = true;
    return;
  }
  const std::size_t row = count * (scene_.float32() ? sizeof(float) : sizeof(double));
  std::vector<std::byte> all(rows * row);
  memory_.moments.read(all.data(), all.size(), first * row);
  patch_bytes(all.data());
  memory_.moments.write(all.data(), all.size(), first * row);
}

const PieceSet& Clipper::finish_on_host(const std::vector<std::uint32_t>& pairs) {
  if (pairs.empty()) return memory_.pieces;
  if (!*host_scene_) *host_scene_ = make_host_scene(scene_);
  const std::size_t count = 2 + static_cast<std::size_t>(scene_.mesh().dimension);
  const std::size_t tasks = (pairs.size() + pairs_of_task - 1) / pairs_of_task,
                    first_batch = memory_.pieces.used;
  for (std::size_t task = 0; task < tasks; ++task) memory_.pieces.add_batch().clear();
  std::vector<double> moments(pairs.size() * count);
  std::vector<std::uint8_t> tied(pairs.size());
  std::vector<std::unique_ptr<HostClipper>> clipper(static_cast<std::size_t>(std::max(1, options_.threads)));
  parallel_tasks(options_.threads, tasks, [&](int worker, std::size_t task) {
    std::unique_ptr<HostClipper>& host = clipper[static_cast<std::size_t>(worker)];
    if (!host)
      host = HostClipper::make(**host_scene_, (outputs_ & (OUTPUT_GEOMETRY | OUTPUT_FACETS)) != 0,
                               options_.perturbed);
    const std::size_t begin = task * pairs_of_task, end = std::min(begin + pairs_of_task, pairs.size());
    PieceBatch unwanted, &rows = wants_rows() ? memory_.pieces.batches[first_batch + task] : unwanted;
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t pair = pairs[k];
      const int status = host->clip(pair_seed_[pair], pair_region_[pair],
                                    std::span(moments).subspan(k * count, count), rows);
      tied[k] = host->met_tie();
      memory_.pieces.status[pair] = static_cast<std::uint32_t>(status);
      if (outputs_ & OUTPUT_REACH) memory_.pieces.reach[pair] = host->radius();
      memory_.pieces.batch[pair] = static_cast<std::uint32_t>(first_batch + task);
      memory_.pieces.row[pair] = static_cast<std::uint32_t>(k - begin);
    }
  });
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (tied[k]) memory_.pieces.tied.push_back(pairs[k]);
  change_moments(pairs, moments);
  statistics_.on_host += pairs.size();
  write_log(LogLevel::detail, [&] { return "pieces finished on the host: " + std::to_string(pairs.size()); });
  return memory_.pieces;
}

}  // namespace powercell
