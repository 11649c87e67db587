#include "lib/diagram/state.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/layout.h"
#include "lib/clip/cell_candidates.hpp"
#include "lib/diagram/chunks.hpp"
#include "lib/diagram/stopwatch.hpp"
#include "lib/domain/outline.hpp"
#include "lib/neighbors/hidden_seeds.hpp"
#include "lib/neighbors/region_candidates.hpp"
#include "lib/neighbors/tree_candidates.hpp"
#include "lib/report/log.hpp"
#include "lib/verify/certificate.hpp"
#ifdef POWERCELL_HAS_FLANN
#include "lib/base/threads.hpp"
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
      clip_mesh(has_inside(domain.mesh()) ? with_container(domain.mesh()) : RegionMesh{}),
      scene(device.context(), has_inside(domain.mesh()) ? clip_mesh : domain.mesh(),
            precision == Precision::float32) {}

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
  if (domain.mesh().region_count() == 1) return std::make_unique<TreeCandidates>(scene);
  std::vector<std::uint32_t> ranks;
  for (std::uint32_t rank = 0; rank < contenders().size(); ++rank)
    if (pairs.offset[rank + 1] > pairs.offset[rank]) ranks.push_back(rank);
  const bool full_dimension = domain.dimension() == domain.cell_dimension();
  if (full_dimension && !whole_cells && pairs.region.size() > pieces_that_pay * ranks.size())
    return std::make_unique<CellCandidates>(scene, ranks);
  return std::make_unique<RegionCandidates>(scene, pairs.list_offset, pairs.list_seed, pairs.all_listed);
}

void Diagram::State::upload(int threads) {
  if (ordered) {
    refit_weights(tree, contenders(), threads);
    scene.set_weights(contenders(), tree, threads);
  } else {
    tree = build_packed_tree(contenders(), threads);
    scene.set_seeds(contenders(), tree, threads);
    ordered = true;
  }
}

void Diagram::State::sift(int threads) {
  if (rest) ordered = paired = false;
  rest.reset();
  upload(threads);
  sifted = true;
  if (neighbors != Neighbors::tree) return;  // lists are the paper's way, and an oracle for the tree's
  const double built_before = device.build_seconds();
  const std::vector<std::uint8_t> hidden = hidden_seeds_if_many(scene);
  timings.prepare -= device.build_seconds() - built_before;
  if (!hidden.empty()) {
    rest = without_hidden(seeds, hidden, threads);
    ordered = paired = false;
    upload(threads);
    write_log(LogLevel::info, [&] {
      return std::to_string(seeds.size() - rest->size()) + " of " + std::to_string(seeds.size()) +
             " seeds are hidden by their neighbours and set aside";
    });
  }
}

void Diagram::State::prepare(bool want_regions) {
  if (ready && whole_cells == (!want_regions && has_inside(domain.mesh()))) return;
  const int threads = thread_count(options.threads);
  if (!ready) {
    Stopwatch tree_watch;
    not_whole.clear();
    if (sifted) {
      upload(threads);
    } else {
      sift(threads);
    }
    timings.prepare += tree_watch.seconds();
  }
  find_pairs(want_regions);
}

bool Diagram::State::cells_come_first(bool want_regions) const {
  return !want_regions && has_inside(domain.mesh()) && neighbors == Neighbors::tree;
}

void Diagram::State::find_pairs_by_cells() {
  Stopwatch watch;
  const BoundaryRanks ranks = finder->at_boundary(contenders(), tree, not_whole, options.progress);
  const double boundary_seconds = watch.seconds(), built_before = device.build_seconds();
  Stopwatch neighbor_watch;
  auto cells_first = std::make_unique<CellCandidates>(scene, ranks.ranks);
  timings.neighbors = neighbor_watch.seconds() - (device.build_seconds() - built_before);
  Stopwatch pair_watch;
  const bool planes = !scene.float32() && contenders().size() < BORDER_PLANE;
  pairs = finder->of_cells(contenders(), ranks, cells_first->walls(), planes, options.progress);
  // The walls go where the candidates go, to which this function belongs.
  cells_first->set_planes(pairs.planes, [this, walls = &cells_first->walls()](std::uint32_t rank) {
    return finder->regions_of(contenders(), rank, *walls);
  });
  timings.pairs = boundary_seconds + pair_watch.seconds();
  candidates = std::move(cells_first);
}

void Diagram::State::find_pairs(bool want_regions) {
  Stopwatch pair_watch;
  ready = false;  // until pairs and candidates are both new: what throws in between must not leave them mixed
  if (!finder) finder.emplace(domain.mesh(), thread_count(options.threads));
  if (cells_come_first(want_regions)) {
    find_pairs_by_cells();
    paired = whole_cells = ready = true;
    timings.pair_count = pairs.region.size();
    return;
  }
  // One region meets all seeds, whatever their weights.
  if (!paired || domain.mesh().region_count() != 1) {
    pairs = want_regions ? finder->all(contenders(), tree, options.progress)
                         : finder->with_whole_cells(contenders(), tree, not_whole, options.progress);
  }
  paired = true;
  whole_cells = !want_regions && has_inside(domain.mesh());
  timings.pairs = pair_watch.seconds();
  timings.pair_count = pairs.region.size();
  Stopwatch neighbor_watch;
  const double built_before = device.build_seconds();
  candidates = make_candidates();
  pairs.list_offset = {};
  pairs.list_seed = {};
  timings.neighbors = neighbor_watch.seconds() - (device.build_seconds() - built_before);
  ready = true;
}

void Diagram::State::silence(std::span<const std::uint32_t> ranks) {
  const auto d = static_cast<std::size_t>(seeds.dimension);
  double diagonal2 = 0, lowest = 0;
  for (std::size_t k = 0; k < d; ++k) {
    double low = domain.low()[k], high = domain.high()[k];
    for (std::size_t at = k; at < seeds.positions.size(); at += d) {
      low = std::min(low, seeds.positions[at]);
      high = std::max(high, seeds.positions[at]);
    }
    diagonal2 += (high - low) * (high - low);
  }
  for (const double w : seeds.weights) lowest = std::max(lowest, std::abs(w));
  // No point of the domain is nearer to it than to all others, by far. A power of two keeps exact numbers
  // short.
  const double down = -std::ldexp(1.0, std::ilogb(std::max(diagonal2, lowest)) + 4);
  SeedSet& weighed = rest ? *rest : seeds;
  for (const std::uint32_t rank : ranks) weighed.weights[rank] = down;
  ready = false;
}

bool Diagram::State::pass_once(bool want_adjacency, bool want_cells) {
  if (!seeds.input.empty()) prepare(want_cells);
  ChunkRun chunks(*this, want_adjacency, want_cells);
  const std::vector<std::uint32_t> unclear = chunks.run();
  if (!chunks.flat_cells().empty()) {
    silence(chunks.flat_cells());
    write_log(LogLevel::info, [&] {
      return std::to_string(chunks.flat_cells().size()) +
             " seeds with flat cells take no part; once more without them";
    });
    return false;
  }
  if (unclear.empty()) return true;
  not_whole.insert(not_whole.end(), unclear.begin(), unclear.end());
  find_pairs(want_cells);
  return false;
}

void Diagram::State::pass(bool want_adjacency, bool want_cells) {
  for (bool done = false; !done;) {
    try {
      done = pass_once(want_adjacency, want_cells);
    } catch (const Error& error) {
      // What was kept may be what is missing.
      if (error.code() != ErrorCode::out_of_device_memory || !clip_memory) throw;
      clip_memory.reset();
    }
  }
}

void Diagram::State::certify() {
  Stopwatch certificate;
  try {
    require_certificate({domain, seeds, *measures, adjacency ? &*adjacency : nullptr,
                         precision == Precision::float32, thread_count(options.threads),
                         [this]() -> const Cells& {
                           if (!cells) pass(false, true);
                           return *cells;
                         }});
  } catch (...) {
    forget_results();
    throw;
  }
  timings.certify = certificate.seconds();
}

void Diagram::State::log_run() const {
  write_log(LogLevel::info, [&] {
    const Timings& t = timings;
    return std::to_string(seeds.size()) + " seeds, " + std::to_string(t.pair_count) + " pairs in " +
           in_seconds(t.total) + " (prepare " + in_seconds(t.prepare) + ", pairs " + in_seconds(t.pairs) +
           ", neighbours " + in_seconds(t.neighbors) + ", clip " + in_seconds(t.clip) + ", collect " +
           in_seconds(t.collect) + ") and " + in_seconds(t.build) + " of compilation; " +
           "pieces finished on the host: " + std::to_string(t.on_host);
  });
}

void Diagram::State::run(bool want_adjacency, bool want_cells) {
  if (!given) throw Error(ErrorCode::invalid_argument, "the diagram has no seeds yet; call set_seeds first");
  const double built_before = device.build_seconds();
  const double prepared = timings.prepare;  // by set_seeds or set_weights
  Stopwatch watch;
  // Measures and adjacency come from the same pairs, whether geometry is asked for before or after.
  if (want_cells && has_inside(domain.mesh())) {
    if (!measures || want_adjacency) pass(want_adjacency, false);
    pass(false, true);
  } else {
    pass(want_adjacency, want_cells);
  }
  if (options.certify) certify();
  timings.build = device.build_seconds() - built_before;
  timings.total = prepared + watch.seconds() - timings.build;
  log_run();
}

}  // namespace powercell
