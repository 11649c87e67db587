#include "lib/diagram/loop.hpp"

#include <algorithm>
#include <powercell/error.hpp>
#include <utility>

#include "lib/diagram/stopwatch.hpp"
#include "lib/report/log.hpp"

namespace powercell {
namespace {

constexpr int changes_of_a_loop = 2;
constexpr unsigned longest_wait = 1U << 20;
/// Of a computation from a mesh, when the mesh is up to date.
constexpr double repaired = 0.3;

void report(const Setup& setup, double fraction) {
  if (setup.options.progress && !setup.options.progress(fraction))
    throw Error(ErrorCode::interrupted, "the computation was stopped by its progress callback");
}

}  // namespace

void Loop::seeds_changed(bool same_seeds, bool was_computed) {
  is_current_ = false;
  if (!same_seeds) {
    *this = {};
    return;
  }
  if (!was_computed) return;
  changes_ = std::min(changes_ + 1, changes_of_a_loop);
  if (changes_ == changes_of_a_loop && wait_ > 0) --wait_;
}

bool Loop::is_due(const Setup& setup, const Input& input) {
  return setup.options.keep_mesh && changes_ >= changes_of_a_loop && wait_ == 0 &&
         setup.options.decisions == Decisions::exact && setup.neighbors == Neighbors::tree &&
         input.seeds.duplicate.empty() && input.seeds.size() > 0 && KeptDiagram::is_possible(setup.on_device);
}

void Loop::fail() {
  mesh_.reset();
  wait_ = std::exchange(next_wait_, std::min(2 * next_wait_, longest_wait));
  // The change that ends the waiting counts too.
  ++wait_;
  write_log(LogLevel::info, [&] {
    return "the dual mesh is of no use for these seeds; the next " + std::to_string(wait_ - 1) +
           " diagrams are computed without one";
  });
}

std::optional<KeptDiagram::Results> Loop::compute(const Setup& setup, const Input& input, bool adjacency,
                                                  Timings& timings) {
  if (!is_due(setup, input)) return {};
  setup.progress->begin_pass(0, 1);
  report(setup, 0);
  try {
    const Stopwatch watch(setup.device);
    if (mesh_ == nullptr) {
      mesh_ = KeptDiagram::make(setup.on_device, input.seeds, setup.threads);
    } else if (!is_current_) {
      mesh_->update(input.seeds, moved_);
      next_wait_ = std::max(next_wait_ / 2, 1U);
    }
    is_current_ = true;
    moved_ = false;
    timings.neighbors = watch.seconds();
    report(setup, repaired);
    KeptDiagram::Results results = mesh_->evaluate(input.seeds, setup.domain.measure(), adjacency);
    timings.clip = watch.seconds() - timings.neighbors;
    timings.pair_count = input.seeds.size();
    timings.reused = input.seeds.size();
    timings.on_host = results.clipped;
    report(setup, 1);
    return results;
  } catch (const MeshUnusable&) {
    fail();
    return {};
  } catch (...) {
    mesh_.reset();
    throw;
  }
}

}  // namespace powercell
