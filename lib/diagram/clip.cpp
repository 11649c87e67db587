#include "lib/diagram/clip.hpp"

#include <algorithm>
#include <deque>
#include <memory>
#include <string>
#include <utility>

#include "lib/base/progress.hpp"
#include "lib/clip/in_chunks.hpp"
#include "lib/diagram/cell_collector.hpp"
#include "lib/diagram/chunk_pipeline.hpp"
#include "lib/diagram/stopwatch.hpp"

namespace powercell {

namespace {

/// Fewer pairs are clipped faster by one device than by several.
constexpr std::uint64_t least_shared_pairs = 16384;
/// Where at most one cell of so many reaches beyond the margin, all images of their seeds are made at once:
/// to clip these cells, which are large, in several rounds costs more than 26 images of each.
constexpr std::size_t seeds_per_cell_beyond = 8;
/// Of a margin that must be widened, against rounding.
constexpr double more_than_needed = 1.001;

class ClipPass {
 public:
  ClipPass(const DiagramSetup& setup, ActiveSeeds& active, ClipPlan& plan, Wanted want, Workspace& workspace)
      : setup_(setup),
        active_(active),
        plan_(plan),
        want_(want),
        workspace_(workspace),
        collector_(setup, active, plan, want, workspace) {}

  Clipped run(Timings& timings) {
    if (!plan_.pairs.region.empty()) clip_all(timings);
    while (collector_.has_beyond() && !want_.unproved) clip_beyond(timings);
    const Stopwatch watch(setup_.device);
    Clipped results = collector_.finish();
    timings.collect = collector_.seconds() + watch.seconds();
    timings.clip = clip_seconds_;
    timings.retried = done_.retried;
    timings.on_host = done_.on_host;
    timings.uncertain = done_.uncertain;
    timings.rounds = done_.rounds;
    return results;
  }

 private:
  void clip_all(Timings& timings);
  /// Clips the cells that reached beyond the margin again, among more images.
  void clip_beyond(Timings& timings);
  /// Calls `body`, which clips by these candidates, and adds its time to the timings.
  template <class Body>
  void timed(const Candidates& candidates, Timings& timings, const Body& body);
  /// \param overlapping  whether a device clips a chunk while the host completes another
  ClipWork work(std::uint64_t total, bool overlapping = false) const;
  /// Whether so many pairs are worth more than one device.
  bool is_shared(std::uint64_t total) const;
  /// Clips and completes the pairs [begin, end) one chunk after the other.
  /// \return the size of a chunk at the end
  std::uint64_t clip_in_turn(ClipDevice& device, ClipChunk& chunk, std::uint64_t begin, std::uint64_t end,
                             std::uint64_t size);
  /// Has the devices clip all pairs while the host completes them.
  /// \return false if the system gives no thread
  bool clip_in_pipeline(std::deque<ClipDevice>& devices, Sharing sharing, std::size_t chunks);
  void keep_shares(const Sharing& sharing, const std::vector<std::uint64_t>& pairs);
  /// Completes a chunk on the host and collects it.
  void complete(ClipChunk& chunk);
  /// To be called for each chunk, when `done` pairs of `total` are.
  void report(ClipChunk& chunk, std::uint64_t done, std::uint64_t total);

  const DiagramSetup& setup_;
  ActiveSeeds& active_;
  ClipPlan& plan_;
  const Wanted want_;
  Workspace& workspace_;
  CellCollector collector_;
  ClipStatistics done_;  // of finished chunks
  Clipper::SharedHostScene host_scene_ = std::make_shared<std::optional<HostScene>>();
  double clip_seconds_ = 0;
};

void ClipPass::complete(ClipChunk& chunk) {
  chunk.clipper->share_host_scene(host_scene_);
  collector_.add(chunk, chunk.clipper->finish_on_host(chunk.for_host));
}

void ClipPass::clip_all(Timings& timings) {
  done_ = plan_.solid_statistics;
  const std::uint64_t total = plan_.pairs.region.size();
  const bool shared = is_shared(total);
  std::deque<ClipDevice> devices;
  std::vector<Sharing::Member> members;
  plan_.copies.resize(setup_.members.size() - 1);
  // The host's cores are idle while one device clips, unless they are the device.
  const bool overlaps =
      shared || (setup_.device.info().type == DeviceInfo::Type::gpu && plan_.candidates->is_shared() &&
                 chunk_pairs(setup_, setup_.members[0], total) < total);
  for (std::size_t k = 0; k < (shared ? setup_.members.size() : 1); ++k) {
    DeviceWorkspace& kept = workspace_.devices[k];
    const Device& device = setup_.members[k];
    if (k == 0)
      devices.emplace_back(work(total, overlaps), device, kept, *plan_.candidates);
    else
      devices.emplace_back(work(total, overlaps), device, kept, *plan_.candidates, plan_.copies[k - 1]);
    members.push_back({chunk_pairs(setup_, device, shared ? 0 : total), kept.speed});
  }
  timed(*plan_.candidates, timings, [&] {
    if (!overlaps || !clip_in_pipeline(devices, Sharing(total, least_chunk_pairs, members),
                                       plan_.candidates->is_shared() ? 2 : 1))
      clip_in_turn(devices[0], devices[0].chunks()[0], 0, total,
                   chunk_pairs(setup_, setup_.members[0], total));
  });
  for (ClipDevice& device : devices) device.keep_memory();
}

bool ClipPass::is_shared(std::uint64_t total) const {
  if (setup_.members.size() == 1) return false;
  return total >= least_shared_pairs ||
         (setup_.options.chunk_pairs > 0 && setup_.options.chunk_pairs < total);
}

ClipWork ClipPass::work(std::uint64_t total, bool overlapping) const {
  return {
      setup_, active_, collector_.outputs(),
      ClipOptions{
          .exact = setup_.exact(), .threads = setup_.threads, .pairs = total, .read_moments = overlapping}};
}

std::uint64_t ClipPass::clip_in_turn(ClipDevice& device, ClipChunk& chunk, std::uint64_t begin,
                                     std::uint64_t end, std::uint64_t size) {
  return in_chunks(
      end - begin, {size, least_chunk_pairs, "pairs"},
      [&](std::uint64_t first, std::uint64_t last) {
        chunk.set_pairs(plan_, begin + first, begin + last);
        device.clip(chunk);
        device.use([&] { complete(chunk); });
        report(chunk, chunk.end, plan_.pairs.region.size());
      },
      [&] { device.free_memory(chunk); });
}

bool ClipPass::clip_in_pipeline(std::deque<ClipDevice>& devices, Sharing sharing, std::size_t chunks) {
  std::vector<std::uint64_t> pairs(devices.size());
  const std::uint64_t total = plan_.pairs.region.size();
  {
    ChunkPipeline pipeline(devices, plan_, sharing, chunks);
    if (!pipeline.start()) return false;
    for (std::uint64_t begin = 0; begin < total;) {
      const ChunkPipeline::Done done = pipeline.wait_for(begin);
      const std::uint64_t end = done.chunk->end;
      if (done.is_clipped) {
        complete(*done.chunk);  // whose moments are on the host: this does not use the device
        report(*done.chunk, end, total);
      } else {
        pipeline.take_over(done);
        pipeline.limit(done.device, clip_in_turn(devices[done.device], *done.chunk, begin, end, end - begin));
      }
      pipeline.release(done);
      pairs[done.device] += end - begin;
      begin = end;
    }
  }
  keep_shares(sharing, pairs);
  return true;
}

void ClipPass::keep_shares(const Sharing& sharing, const std::vector<std::uint64_t>& pairs) {
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (pairs[k] > 0) workspace_.devices[k].speed = sharing.speed(k);
    workspace_.devices[k].pairs = pairs[k];
  }
  if (pairs.size() == 1) return;
  write_log(LogLevel::info, [&] {
    std::string shares;
    for (std::size_t k = 0; k < pairs.size(); ++k)
      shares += (k > 0 ? ", " : "") + setup_.members[k].info().selector() + " " + std::to_string(pairs[k]);
    return "pairs clipped by each device: " + shares;
  });
}

void ClipPass::report(ClipChunk& chunk, std::uint64_t done, std::uint64_t total) {
  done_.add(chunk.clipper->take_statistics());
  write_log(LogLevel::detail,
            [&] { return std::to_string(done) + " of " + std::to_string(total) + " pairs clipped"; });
  report_progress(setup_.options.progress, static_cast<double>(done), static_cast<double>(total));
}

template <class Body>
void ClipPass::timed(const Candidates& candidates, Timings& timings, const Body& body) {
  const double list_seconds_before = candidates.host_seconds(), collected_before = collector_.seconds();
  const Stopwatch watch(setup_.device);
  body();
  const double list_seconds = candidates.host_seconds() - list_seconds_before;
  timings.neighbors += list_seconds;
  // Several devices make lists while others clip, so that the sum of the parts may be more than the whole.
  clip_seconds_ += std::max(0.0, watch.seconds() - (collector_.seconds() - collected_before) - list_seconds);
}

void ClipPass::clip_beyond(Timings& timings) {
  // A cell that lacks an image reaches farther than it will.
  const Images& images = *active_.images();
  const double margin = collector_.beyond() * seeds_per_cell_beyond < images.own
                            ? complete_margin(*setup_.period())
                            : std::min(more_than_needed * collector_.margin(), 2 * images.margin);
  if (!active_.widen(margin, collector_.clearance())) return collector_.prove_again();
  const std::vector<std::uint32_t> rows = collector_.take_beyond();
  write_log(LogLevel::info, [&] {
    return std::to_string(active_.seeds().size() - active_.images()->own) + " images of " +
           std::to_string(active_.images()->own) + " seeds, because " + std::to_string(rows.size()) +
           " cells reached beyond a narrower margin";
  });
  host_scene_ = std::make_shared<std::optional<HostScene>>();
  const std::vector<std::uint32_t> regions(rows.size());
  const std::unique_ptr<Candidates> candidates = search_all(setup_, active_.scene());
  const std::uint64_t total = rows.size();
  const Device& first = setup_.members.front();
  ClipDevice device(work(total), first, workspace_.devices[0], *candidates);
  ClipChunk& chunk = device.chunks()[0];
  timed(*candidates, timings, [&] {
    in_chunks(
        total, {chunk_pairs(setup_, first, total), least_chunk_pairs, "pairs"},
        [&](std::uint64_t begin, std::uint64_t end) {
          chunk.pair_row.assign(rows.begin() + static_cast<std::ptrdiff_t>(begin),
                                rows.begin() + static_cast<std::ptrdiff_t>(end));
          chunk.set_seeds(plan_);
          chunk.pair_region = std::span(regions).subspan(begin, end - begin);
          device.clip(chunk);
          chunk.clipper->share_host_scene(host_scene_);
          collector_.replace(chunk, chunk.clipper->finish_on_host(chunk.for_host));
          report(chunk, end, total);
        },
        [&] { device.free_memory(chunk); });
  });
  device.keep_memory();
}

}  // namespace

Clipped clip(const DiagramSetup& setup, ActiveSeeds& active, ClipPlan& plan, Wanted want,
             Workspace& workspace, Timings& timings) {
  return ClipPass(setup, active, plan, want, workspace).run(timings);
}

}  // namespace powercell
