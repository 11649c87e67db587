// Seeds that are shared out anew, and the shapes of cells on ranks, with the diagram of all seeds as the
// oracle.
#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <limits>
#include <mutex>
#include <powercell/local_diagram.hpp>
#include <powercell/redistributed_seeds.hpp>

#include "tests/distributed/ranks.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// Runs `work(communicator, own seeds)` on all ranks. \throw what the first rank threw that did
template <class Work>
void on_shares(const Shares& shares, const Work& work) {
  const std::vector<exchange::ShardSeeds> view = shares.view();
  for (const std::exception_ptr& thrown : on_ranks(view.size(), [&](Communicator& communicator) {
         work(communicator, view[static_cast<std::size_t>(communicator.rank())]);
       }))
    if (thrown) std::rethrow_exception(thrown);
}

/// The rows of a local diagram are those of a diagram of all seeds, which has them at their ids.
void check_local(LocalDiagram& local, Diagram& all) {
  const Adjacency &walls = local.diagram.adjacency(), &all_walls = all.adjacency();
  const JoinedCells &shapes = local.diagram.joined(), &all_shapes = all.joined();
  const double mean = all.measures().domain_measure / static_cast<double>(all.size());
  for (std::size_t row = 0; row < local.cells.size(); ++row) {
    const std::uint64_t id = local.ids.at(local.cells[row]);
    CAPTURE(id);
    const double mass = all.measures().mass[id];
    CHECK(std::abs(local.diagram.measures().mass[row] - mass) <=
          measure_error(all.domain(), std::max(mean, mass)));
    std::vector<std::uint64_t> neighbors;
    for (std::uint64_t w = walls.offset[row]; w < walls.offset[row + 1]; ++w)
      neighbors.push_back(local.ids.at(walls.neighbor[w]));
    CHECK(neighbors ==
          std::vector<std::uint64_t>(
              all_walls.neighbor.begin() + static_cast<std::ptrdiff_t>(all_walls.offset[id]),
              all_walls.neighbor.begin() + static_cast<std::ptrdiff_t>(all_walls.offset[id + 1])));
    CHECK(shapes.vertex_offset[row + 1] - shapes.vertex_offset[row] ==
          all_shapes.vertex_offset[id + 1] - all_shapes.vertex_offset[id]);
    CHECK(shapes.face_offset[row + 1] - shapes.face_offset[row] ==
          all_shapes.face_offset[id + 1] - all_shapes.face_offset[id]);
  }
}

/// Shares out, computes, compares shapes on each rank and results that were sent back. \return cells in all
std::size_t check_shapes(Diagram& all, const Shares& shares) {
  std::atomic<std::size_t> cells = 0;
  std::mutex one;  // all ranks compare with the same diagram
  on_shares(shares, [&](Communicator& communicator, const exchange::ShardSeeds& given) {
    RedistributedSeeds moved(communicator, given.ids, given.seeds, &all.domain());
    const DistributedCells found =
        compute_distributed(communicator, test_device(), all.domain(), moved.ids(), moved.seeds());
    LocalDiagram local =
        local_diagram(communicator, test_device(), all.domain(), moved.ids(), moved.seeds(), found);
    const DistributedCells back = moved.send_back(found);
    const std::lock_guard lock(one);
    check_local(local, all);
    check_cells(all, {given.ids.begin(), given.ids.end()}, back);
    CHECK(back.report.rounds == found.report.rounds);
    cells += local.cells.size();
  });
  return cells;
}

std::size_t count_cells(const Measures& measures) {
  return static_cast<std::size_t>(std::count(measures.status.begin(), measures.status.end(), SeedStatus::ok));
}

}  // namespace

TEST_CASE("shapes: those of one diagram, of seeds that were shared out anew") {
  INFO(replay_hint());
  Random random(test_seed());
  const std::array low{0.0, 0.0, 0.0}, high{1.0, 1.0, 1.0};
  const std::vector<NamedDomain> domains{{"square", unit_box(2)},
                                         {"cube", unit_box(3)},
                                         {"periodic cube", Domain::periodic_box(low, high)},
                                         {"islands", Domain::polygon(islands())},
                                         {"ball", volume_of(ball_tetrahedra(0))}};
  for (const NamedDomain& named : domains)
    for (const WeightRange range : {WeightRange::W0, WeightRange::W2}) {
      INFO(named.name << " " << name(range));
      const SeedArray seeds = seeds_for(named.domain, Distribution::white, range, 300, random);
      Diagram all = diagram_of(named.domain, seeds);
      for (const std::size_t ranks : {1, 3}) {
        CAPTURE(ranks);
        CHECK(check_shapes(all, at_random(seeds, ranks, random)) == count_cells(all.measures()));
      }
    }
}

TEST_CASE("shapes: grids, whose ties go by the ids, duplicates, few seeds and none") {
  INFO(replay_hint());
  Random random(test_seed());
  SeedArray grid{3, {}, {}};
  for (std::size_t i = 0; i < 5 * 5 * 5; ++i)
    grid.push({0.1 + 0.2 * static_cast<double>(i % 5), 0.1 + 0.2 * static_cast<double>(i / 5 % 5),
               0.1 + 0.2 * static_cast<double>(i / 25)},
              0);
  for (std::size_t i = 0; i < 9; ++i) grid.push({0.5, 0.1 + 0.2 * static_cast<double>(i % 5), 0.5}, 0);
  Diagram all = diagram_of(unit_box(3), grid);
  for (const std::size_t ranks : {2, 5}) check_shapes(all, at_random(grid, ranks, random));
  const SeedArray few = random_seeds(Distribution::white, WeightRange::W1, 2, 2, random);
  Diagram small = diagram_of(unit_box(2), few);
  CHECK(check_shapes(small, {few, {0, 3}, 4}) == count_cells(small.measures()));
  const SeedArray none{2, {}, {}};
  Diagram empty = diagram_of(unit_box(2), none);
  CHECK(check_shapes(empty, {none, {}, 2}) == 0);
}

TEST_CASE("shapes: seeds shared out anew are near each other, about as many on each rank, and all there") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 4000, 2, random);
  const Shares shares(seeds, std::vector<std::size_t>(seeds.size(), 1), 4);  // all on one
  std::mutex one;
  std::vector<int> seen(seeds.size());
  on_shares(shares, [&](Communicator& communicator, const exchange::ShardSeeds& given) {
    const RedistributedSeeds moved(communicator, given.ids, given.seeds);
    const std::lock_guard lock(one);
    std::array low{1.0, 1.0}, high{0.0, 0.0};
    for (std::size_t k = 0; k < moved.ids().size(); ++k) {
      const std::uint64_t id = moved.ids()[k];
      ++seen[id];
      CHECK(moved.seeds().weights[k] == seeds.weights[id]);
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const double x = moved.seeds().positions[2 * k + axis];
        CHECK(x == seeds.positions[2 * id + axis]);
        low[axis] = std::min(low[axis], x);
        high[axis] = std::max(high[axis], x);
      }
    }
    CHECK(std::abs(static_cast<double>(moved.ids().size()) - 1000) < 200);
    // A quarter of the curve of Hilbert through a square is one of its quarters, about.
    CHECK((high[0] - low[0]) * (high[1] - low[1]) < 0.4);
  });
  CHECK(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
}

TEST_CASE("shapes: seeds given some periods outside are shared out by where they are wrapped to") {
  INFO(replay_hint());
  Random random(test_seed());
  const std::array low{0.0, 0.0}, high{1.0, 1.0};
  const Domain domain = Domain::periodic_box(low, high);
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 3000, 2, random);
  const auto fetched = [&](const Domain* known) {
    std::atomic<std::uint64_t> sent = 0;
    on_shares(at_random(seeds, 3, random), [&](Communicator& communicator,
                                               const exchange::ShardSeeds& given) {
      const RedistributedSeeds moved(communicator, given.ids, given.seeds, known);
      sent =
          compute_distributed(communicator, test_device(), domain, moved.ids(), moved.seeds()).report.fetched;
    });
    return static_cast<double>(sent.load());
  };
  const double inside = fetched(&domain);
  for (double& x : seeds.positions) x += static_cast<double>(random.index(5)) - 2;
  const double wrapped = fetched(&domain), as_given = fetched(nullptr);
  CHECK(std::abs(wrapped - inside) < 0.1 * inside);
  CHECK(as_given > 3 * wrapped);
}

TEST_CASE("shapes: what is refused") {
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 50, 3, random);
  const Shares shares = at_random(seeds, 2, random);
  const auto refusal = [&](const auto& work) {
    try {
      on_shares(shares, work);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(refusal([&](Communicator& communicator, const exchange::ShardSeeds& own) {
          RedistributedSeeds(communicator, own.ids,
                             {communicator.rank() == 0 ? 3 : 2,
                              communicator.rank() == 0 ? own.seeds.positions : std::span<double>(),
                              communicator.rank() == 0 ? own.seeds.weights : std::span<double>()});
        }) != "");
  CHECK(refusal([&](Communicator& communicator, const exchange::ShardSeeds& own) {
          std::vector<double> positions(own.seeds.positions.begin(), own.seeds.positions.end());
          if (communicator.rank() == 1) positions[4] = std::numeric_limits<double>::quiet_NaN();
          RedistributedSeeds(communicator, own.ids, {3, positions, own.seeds.weights});
        }) == "rank 1: seed " + std::to_string(shares.ids[1][1]) + ": its position is not finite");
  CHECK(refusal([&](Communicator& communicator, const exchange::ShardSeeds& own) {
          RedistributedSeeds moved(communicator, own.ids, own.seeds);
          moved.send_back({});
        }).find("0 cells of ") != std::string::npos);
  // Seeds that were shared out can be used after errors of one rank, as often as there are some.
  on_shares(shares, [&](Communicator& communicator, const exchange::ShardSeeds& own) {
    RedistributedSeeds moved(communicator, own.ids, own.seeds);
    const DistributedCells cells =
        compute_distributed(communicator, test_device(), unit_box(3), moved.ids(), moved.seeds());
    for (int time = 0; time < 2; ++time)
      CHECK_THROWS_WITH_AS(moved.send_back(communicator.rank() == 0 ? DistributedCells() : cells),
                           doctest::Contains("rank 0: 0 cells of "), Error);
    CHECK(moved.send_back(cells).offset.size() == own.ids.size() + 1);
  });
  CHECK(refusal([&](Communicator& communicator, const exchange::ShardSeeds& own) {
          DistributedCells cells =
              compute_distributed(communicator, test_device(), unit_box(3), own.ids, own.seeds);
          if (communicator.rank() == 0 && !cells.neighbor.empty()) cells.neighbor[0] = 1234567;
          local_diagram(communicator, test_device(), unit_box(3), own.ids, own.seeds, cells);
        }).find("seed 1234567 is a neighbour, but no rank has it") != std::string::npos);
}
