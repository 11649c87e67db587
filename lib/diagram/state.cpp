#include "lib/diagram/state.hpp"

#include <utility>

#include "lib/collect/dual.hpp"
#include "lib/collect/facets.hpp"
#include "lib/diagram/facets.hpp"
#include "lib/diagram/stopwatch.hpp"
#include "lib/report/log.hpp"
#include "lib/verify/certificate.hpp"

namespace powercell {
namespace {

void log_run(std::size_t seeds, const Timings& t) {
  write_log(LogLevel::info, [&] {
    return std::to_string(seeds) + " seeds, " + std::to_string(t.pair_count) + " pairs in " +
           in_seconds(t.total) + " (prepare " + in_seconds(t.prepare) + ", pairs " + in_seconds(t.pairs) +
           ", neighbours " + in_seconds(t.neighbors) + ", clip " + in_seconds(t.clip) + ", collect " +
           in_seconds(t.collect) + ") and " + in_seconds(t.build) + " of compilation; " +
           "pieces finished on the host: " + std::to_string(t.on_host);
  });
}

}  // namespace

void Diagram::State::set_seeds(const SeedsView& seeds) {
  const Stopwatch watch(setup.device);
  GivenSeeds next = make_given_seeds(setup, seeds);
  retire_active();
  tree.reset();
  input = std::move(next);
  selection.reset();
  timings = {};
  timings.prepare = watch.seconds();
}

void Diagram::State::select(std::span<const std::uint32_t> seeds) {
  if (!input) throw Error(ErrorCode::invalid_argument, "the diagram has no seeds yet; call set_seeds first");
  if (setup.options.certify)
    throw Error(ErrorCode::unsupported,
                "the laws that Options::certify checks are those of all cells; turn it off, or select none");
  Selection next = checked_selection(seeds, input->seeds.input_count);
  select_all();
  selection = std::move(next);
}

void Diagram::State::select_all() {
  results = std::make_shared<Results>();
  // In a domain of one region all selections are searched for in the same way.
  const bool same_search = setup.domain.region_count() == 1 && setup.neighbors == Neighbors::tree;
  if (integrals && same_search && integrals->seeds == active->seeds().size())
    workspace.search = std::move(integrals->candidates);
  integrals.reset();
  geometry.reset();
  selection.reset();
}

void Diagram::State::set_weights(std::span<const double> weights) {
  if (!input) throw Error(ErrorCode::invalid_argument, "the diagram has no seeds yet; call set_seeds first");
  const Stopwatch watch(setup.device);
  const bool same_positions = input->seeds.duplicate.empty();
  GivenSeeds next = with_weights(setup, std::move(*input), weights);
  retire_active();
  if (!same_positions) tree.reset();
  input = std::move(next);
  timings = {};
  timings.prepare = watch.seconds();
}

void Diagram::State::retire_active() {
  results = std::make_shared<Results>();
  workspace.search.reset();
  integrals.reset();
  geometry.reset();
  if (active) tree = std::move(*active).release_tree();
  active.reset();
}

ClipPlan& Diagram::State::plan(PlanKind kind) {
  std::optional<ClipPlan>& kept =
      kind == PlanKind::geometry && setup.has_inside && !selection ? geometry : integrals;
  if (kept && kept->seeds != active->seeds().size()) kept.reset();  // images were added
  if (!kept) kept = make_plan(setup, *active, kind, selection ? &*selection : nullptr, workspace, timings);
  return *kept;
}

void Diagram::State::make_active() {
  if (active) return;
  const Stopwatch watch(setup.device);
  active.emplace(setup, *input, seed_buffers, std::exchange(tree, std::nullopt));
  timings.prepare += watch.seconds();
}

bool Diagram::State::release_memory() {
  bool any = workspace.facets.has_value();
  workspace.facets.reset();
  for (DeviceWorkspace& device : workspace.devices)
    for (std::optional<ClipMemory>& memory : device.clip) {
      any = any || memory.has_value();
      memory.reset();
    }
  return any;
}

template <class Body>
auto Diagram::State::within_memory(const Body& body) {
  for (;;) {
    try {
      return body();
    } catch (const Error& error) {
      if (error.code() != ErrorCode::out_of_device_memory || !release_memory()) throw;
    }
  }
}

void Diagram::State::pass(PlanKind kind, Wanted want) {
  for (;;) {
    Clipped clipped = within_memory([&] {
      ClipPlan& made = on_device(setup, setup.members.front(), [&]() -> ClipPlan& {
        make_active();
        return plan(kind);
      });
      return clip(setup, *active, made, want, workspace, timings);
    });
    if (clipped.measures) return store(std::move(clipped));
    // The walls of an excluded flat cell are those of its neighbours, so all cells are clipped again.
    if (!clipped.flat.empty()) {
      active->exclude_flat_cells(clipped.flat);
      geometry.reset();
    } else {
      active->by_region.insert(active->by_region.end(), clipped.unclear.begin(), clipped.unclear.end());
    }
    integrals.reset();
  }
}

void Diagram::State::store(Clipped&& clipped) {
  // The measures of an earlier pass by unrestricted cells are kept.
  if (!results->measures) results->measures = std::move(clipped.measures);
  if (clipped.adjacency) results->adjacency = std::move(clipped.adjacency);
  if (clipped.cells) results->cells = std::move(clipped.cells);
  if (clipped.reach) results->reach = std::move(clipped.reach);
  results->unproved = std::move(clipped.unproved);
  if (!clipped.solid) return;
  results->joined = std::move(clipped.solid->joined);
  results->simplices = std::move(clipped.solid->simplices);
  geometry.reset();  // it has all cells at the boundary
}

void Diagram::State::compute_missing(Wanted want) {
  if (selection && setup.domain.is_solid()) {
    compute_in_solid(want);
  } else if (want.cells && setup.domain.is_solid()) {
    setup.progress->begin_pass(0, 1);
    pass(PlanKind::geometry, want);
  } else if (want.cells && setup.has_inside && !selection) {
    // Measures and adjacency always come from this pass, so they do not depend on the order of calls.
    const bool both = !results->measures || want.adjacency;
    setup.progress->begin_pass(0, 0.5);
    if (both) pass(PlanKind::integrals, {.adjacency = want.adjacency});
    setup.progress->begin_pass(both ? 0.5 : 0, 1);
    pass(PlanKind::geometry, {.cells = true});
  } else {
    setup.progress->begin_pass(0, 1);
    pass(PlanKind::integrals, want);
  }
}

void Diagram::State::compute_in_solid(Wanted want) {
  // The caller may refer to results that are there already, so they are not replaced.
  std::shared_ptr<Results> selected = std::exchange(results, std::make_shared<Results>());
  std::optional<Selection> asked = std::exchange(selection, std::nullopt);
  const auto restore = [&] {
    selection = std::move(asked);
    std::swap(results, selected);
  };
  try {
    compute_missing(want);
  } catch (...) {
    restore();
    throw;
  }
  restore();
  const Results& all = *selected;
  if (!results->measures) results->measures = select_rows(*all.measures, *selection);
  if (all.adjacency) results->adjacency = select_rows(*all.adjacency, *selection);
  if (all.joined) results->joined = select_rows(*all.joined, *selection);
}

void Diagram::State::compute(Wanted want) {
  want.adjacency = want.adjacency && !results->adjacency;
  want.cells = want.cells && !results->cells && !(setup.domain.is_solid() && results->joined);
  want.reach = want.reach && !results->reach;
  if (results->measures && !want.adjacency && !want.cells && !want.reach) return;
  if (!input) throw Error(ErrorCode::invalid_argument, "the diagram has no seeds yet; call set_seeds first");
  const double built_before = setup.device.build_seconds();
  const double prepared = timings.prepare;  // by set_seeds or set_weights
  const Stopwatch watch(setup.device);
  setup.progress->begin_computation();
  compute_missing(want);
  if (setup.options.certify) certify();
  timings.build = setup.device.build_seconds() - built_before;
  timings.total = prepared + watch.seconds();
  log_run(input->seeds.size(), timings);
}

void Diagram::State::certify() {
  const Stopwatch watch(setup.device);
  try {
    require_certificate({setup.domain, input->seeds,
                         active && active->images() ? active->seeds() : input->seeds, *results->measures,
                         results->adjacency ? &*results->adjacency : nullptr, setup.float32(), setup.threads,
                         [this]() -> const Cells& {
                           if (!results->cells) pass(PlanKind::geometry, {.cells = true});
                           return *results->cells;
                         }});
  } catch (...) {
    results = std::make_shared<Results>();
    throw;
  }
  timings.certify = watch.seconds();
}

const BoundaryWalls& Diagram::State::boundary_walls() {
  if (results->boundary_walls) return *results->boundary_walls;
  if (setup.domain.is_solid()) {
    results->boundary_walls = facets_of(joined());
    return *results->boundary_walls;
  }
  compute({});  // excludes flat cells, and has images enough
  setup.progress->begin_computation();
  setup.progress->begin_pass(0, 1);
  results->boundary_walls = within_memory([&] {
    return on_device(setup, setup.members.front(), [&] {
      make_active();
      return clip_facets(setup, *active, plan(PlanKind::geometry), results->measures->status);
    });
  });
  return *results->boundary_walls;
}

const Cells& Diagram::State::cells() {
  if (setup.domain.is_solid())
    throw Error(ErrorCode::unsupported,
                "cells of a solid are not cut into convex pieces; their geometry is that of the joined cells "
                "(Diagram::joined); for pieces, and for all that needs them, give a tetrahedral mesh of the "
                "solid (Domain::volume)");
  compute({.cells = true});
  return *results->cells;
}

const JoinedCells& Diagram::State::joined() {
  if (setup.domain.is_solid())
    compute({.cells = true});
  else if (!results->joined)
    results->joined = join(setup.domain, cells());
  return *results->joined;
}

const Dual& Diagram::State::dual() {
  if (results->dual) return *results->dual;
  if (selection)
    throw Error(ErrorCode::unsupported, "the dual is that of all cells; call select_all() before it");
  compute({.cells = true});
  const SeedRows given = input->given();
  const SeedsView seeds{setup.domain.dimension(), given.positions, given.weights};
  if (results->simplices)
    results->dual = extend_dual({4, {}, {}}, *results->simplices, seeds);
  else if (setup.period())
    results->dual = make_periodic_dual(*results->cells, given.positions, setup.domain.periods());
  else
    results->dual = make_dual(*results->cells, seeds);
  return *results->dual;
}

}  // namespace powercell
