#include "lib/diagram/state.hpp"

#include <algorithm>

#include "kernels/layout.h"
#include "lib/diagram/chunks.hpp"
#include "lib/diagram/stopwatch.hpp"
#include "lib/neighbors/cell_candidates.hpp"
#include "lib/neighbors/tree_candidates.hpp"
#ifdef POWERCELL_HAS_FLANN
#include "lib/neighbors/list_candidates.hpp"
#endif

namespace powercell {

Precision choose_precision(const Device& device, Precision asked) {
  const bool fp64 = device.info().fp64;
  if (asked == Precision::automatic) return fp64 ? Precision::float64 : Precision::float32;
  if (asked == Precision::float64 && !fp64)
    throw Error(ErrorCode::no_fp64, "device \"" + device.info().name +
                                        "\" has no double precision; use single precision or another device");
  return asked;
}

namespace {

Neighbors choose_neighbors(Neighbors asked) {
#ifndef POWERCELL_HAS_FLANN
  if (asked == Neighbors::flann)
    throw Error(ErrorCode::unsupported,
                "this build has no FLANN; use the tree, or build with POWERCELL_FLANN=ON");
#endif
  return asked == Neighbors::automatic ? Neighbors::tree : asked;
}

/// Pieces a cell from which on it is faster to clip whole cells first (docs/performance.md).
constexpr std::size_t pieces_that_pay = 3;

Options checked(Options options) {
  const auto refuse = [](const char* name, int value) {
    throw Error(ErrorCode::invalid_argument, std::string(name) + " is " + std::to_string(value) +
                                                 "; it must not be negative (0 lets the library choose)");
  };
  if (options.initial_neighbors < 0) refuse("initial_neighbors", options.initial_neighbors);
  if (options.threads < 0) refuse("threads", options.threads);
  return options;
}

}  // namespace

Diagram::State::State(Device device_in, Domain domain_in, Options options_in)
    : device(std::move(device_in)),
      domain(std::move(domain_in)),
      options(checked(std::move(options_in))),
      precision(choose_precision(device, options.precision)),
      neighbors(choose_neighbors(options.neighbors)),
      scene(device.context(), domain.mesh(), precision == Precision::float32) {}

void Diagram::State::forget_results() {
  measures.reset();
  adjacency.reset();
  cells.reset();
  dual.reset();
}

std::unique_ptr<Candidates> Diagram::State::make_candidates() const {
#ifdef POWERCELL_HAS_FLANN
  if (neighbors == Neighbors::flann) return std::make_unique<ListCandidates>(scene, options);
#endif
  std::vector<std::uint32_t> ranks;
  for (std::uint32_t rank = 0; rank < seeds.size(); ++rank)
    if (pairs.offset[rank + 1] > pairs.offset[rank]) ranks.push_back(rank);
  const bool full_dimension = domain.dimension() == domain.cell_dimension();
  if (full_dimension && pairs.region.size() > pieces_that_pay * ranks.size())
    return std::make_unique<CellCandidates>(scene, ranks);
  return std::make_unique<TreeCandidates>(scene);
}

void Diagram::State::prepare() {
  if (ready) return;
  const int threads = thread_count(options.threads);
  Stopwatch tree_watch;
  if (ordered) {
    refit_weights(tree, seeds, threads);
    scene.set_weights(seeds, tree, threads);
  } else {
    tree = build_packed_tree(seeds, threads);
    scene.set_seeds(seeds, tree, threads);
    ordered = true;
  }
  timings.prepare += tree_watch.seconds();
  Stopwatch pair_watch;
  // One region meets all seeds, whatever their weights.
  if (!paired || domain.mesh().region_count() != 1)
    pairs = enumerate_pairs(domain.mesh(), seeds, tree, threads, options.progress);
  paired = true;
  timings.pairs = pair_watch.seconds();
  timings.pair_count = pairs.region.size();
  Stopwatch neighbor_watch;
  const double built_before = device.build_seconds();
  candidates = make_candidates();
  timings.neighbors = neighbor_watch.seconds() - (device.build_seconds() - built_before);
  ready = true;
}

void Diagram::State::run(bool want_adjacency, bool want_cells) {
  if (!given) throw Error(ErrorCode::invalid_argument, "the diagram has no seeds yet; call set_seeds first");
  const double built_before = device.build_seconds();
  const double prepared = timings.prepare;  // by set_seeds or set_weights
  Stopwatch watch;
  if (!ready && !seeds.input.empty()) prepare();
  ChunkRun chunk_run(*this, want_adjacency, want_cells);
  chunk_run.run();
  timings.build = device.build_seconds() - built_before;
  timings.total = prepared + watch.seconds() - timings.build;
}

}  // namespace powercell
