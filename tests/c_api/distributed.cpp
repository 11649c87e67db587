// Seeds on ranks from C: the same bits as from C++, shapes, and seeds that are shared out anew.
#include <cstring>
#include <mutex>
#include <optional>
#include <powercell/local_diagram.hpp>
#include <powercell/redistributed_seeds.hpp>

#include "tests/c_api/ranks.hpp"

namespace powercell::c_ranks_test {
namespace {

template <class T>
bool same_bits(const T* values, std::size_t count, const std::vector<T>& expected) {
  return count == expected.size() &&
         (count == 0 || std::memcmp(values, expected.data(), count * sizeof(T)) == 0);
}

void check_report(const pc_exchange_report& report, const ExchangeReport& expected) {
  CHECK(report.rounds == static_cast<std::uint64_t>(expected.rounds));
  CHECK(report.fetched == expected.fetched);
  CHECK(report.neighbors == expected.neighbors);
  CHECK(report.clipped == expected.clipped);
  CHECK(report.vertices == expected.vertices);
  CHECK(report.outlines == expected.outlines);
  CHECK(report.requests == expected.requests);
  CHECK(report.replies == expected.replies);
  CHECK(report.ending == expected.ending);
  CHECK(report.redistributed == expected.redistributed);
}

void check_same(const pc_distributed_cells& cells, const DistributedCells& expected) {
  const pc_measures& measures = *cells.measures;
  const std::size_t n = cells.count, d = static_cast<std::size_t>(expected.measures.dimension);
  REQUIRE(n == expected.measures.mass.size());
  CHECK(measures.count == n);
  CHECK(measures.dimension == expected.measures.dimension);
  CHECK(same_bits(measures.mass, n, expected.measures.mass));
  CHECK(same_bits(measures.centroid, n * d, expected.measures.centroid));
  CHECK(same_bits(measures.second_moment, n, expected.measures.second_moment));
  CHECK(same_bits(reinterpret_cast<const SeedStatus*>(measures.status), n, expected.measures.status));
  CHECK(measures.total == expected.measures.total());
  CHECK(measures.domain_measure == expected.measures.domain_measure);
  CHECK(same_bits(cells.offset, n + 1, expected.offset));
  REQUIRE(cells.entry_count == expected.neighbor.size());
  CHECK(same_bits(cells.neighbor, cells.entry_count, expected.neighbor));
  CHECK(same_bits(cells.wall, cells.entry_count, expected.wall));
  CHECK((cells.shift != nullptr) == !expected.shift.empty());
  for (std::size_t k = 0; k < expected.shift.size(); ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) CHECK(cells.shift[3 * k + axis] == expected.shift[k][axis]);
  check_report(*cells.report, expected.report);
}

/// The cells of all ranks from C are those from C++.
void check_as_from_cpp(const Domain& domain, const Shares& shares, bool redistribute = false) {
  const std::vector<DistributedCells> expected = on_ranks(domain, shares, {{}, redistribute});
  const pc_domain handle(domain);
  pc_distributed_options options;
  REQUIRE(pc_distributed_options_init(&options, sizeof options) == PC_OK);
  options.redistribute = redistribute ? 1 : 0;
  on_c_ranks(shares.ids.size(), [&](Rank& rank) {
    Arguments arguments(rank, handle, shares);
    if (redistribute) arguments.options = &options;
    Cells cells;
    REQUIRE(arguments.compute(&cells.handle) == PC_OK);
    check_same(*cells.handle, expected[static_cast<std::size_t>(arguments.communicator.rank)]);
  });
}

}  // namespace

TEST_CASE("ranks from C: the bits of C++, of all weights, clustered or not, sent to others or not") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int dimension : {2, 3})
    for (const Distribution distribution : {Distribution::white, Distribution::cluster})
      for (const WeightRange range : {WeightRange::W0, WeightRange::W1, WeightRange::W2}) {
        INFO(dimension << "D " << name(distribution) << " " << name(range));
        const SeedArray seeds = random_seeds(distribution, range, 300, dimension, random);
        check_as_from_cpp(unit_box(dimension), along_curve(seeds, 2));
        check_as_from_cpp(unit_box(dimension), at_random(seeds, 3, random));
        check_as_from_cpp(unit_box(dimension), at_random(seeds, 5, random), true);
        check_as_from_cpp(unit_box(dimension), at_random(seeds, 1, random));
      }
}

TEST_CASE("ranks from C: shifts in periodic boxes and lattices") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const NamedDomain& named : periodic_domains()) {
    INFO(named.name);
    const SeedArray seeds = seeds_for(named.domain, Distribution::white, WeightRange::W1, 200, random);
    check_as_from_cpp(named.domain, along_curve(seeds, 3));
    check_as_from_cpp(named.domain, at_random(seeds, 2, random), true);
  }
}

TEST_CASE("ranks from C: without seeds, more of them than seeds, and no seeds at all") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 100, 3, random),
                  few = random_seeds(Distribution::white, WeightRange::W1, 3, 2, random);
  std::vector<std::size_t> odd(seeds.size());
  for (std::size_t i = 0; i < odd.size(); ++i) odd[i] = 1 + 2 * (i % 2);
  for (const bool redistribute : {false, true}) {
    check_as_from_cpp(unit_box(3), {seeds, odd, 5}, redistribute);
    check_as_from_cpp(unit_box(2), {few, {4, 0, 4}, 6}, redistribute);
    check_as_from_cpp(unit_box(2), Shares(SeedArray{2, {}, {}}, {}, 3), redistribute);
  }
}

TEST_CASE("ranks from C: NULL for weights that are 0") {
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 100, 2, random);
  const Shares shares = at_random(seeds, 2, random);
  const std::vector<DistributedCells> expected = on_ranks(unit_box(2), shares);
  const pc_domain domain(unit_box(2));
  on_c_ranks(2, [&](Rank& rank) {
    Arguments arguments(rank, domain, shares);
    arguments.weights = nullptr;
    Cells cells;
    REQUIRE(arguments.compute(&cells.handle) == PC_OK);
    check_same(*cells.handle, expected[static_cast<std::size_t>(arguments.communicator.rank)]);
  });
}

namespace {

using Seeds = c_api_test::Owned<const pc_redistributed_seeds, pc_redistributed_seeds_destroy>;
using Local = c_api_test::Owned<const pc_local_diagram, pc_local_diagram_destroy>;

/// What C++ makes of seeds that it shares out anew.
struct OfCpp {
  std::vector<std::uint64_t> ids;
  std::vector<double> positions, weights;
  DistributedCells there, back;
  std::optional<LocalDiagram> local;
};

std::vector<OfCpp> shapes_of_cpp(const Domain& domain, const Shares& shares) {
  const std::vector<exchange::ShardSeeds> view = shares.view();
  std::vector<OfCpp> found(view.size());
  for (const std::exception_ptr& thrown : on_ranks(view.size(), [&](Communicator& communicator) {
         const auto rank = static_cast<std::size_t>(communicator.rank());
         RedistributedSeeds moved(communicator, view[rank].ids, view[rank].seeds, &domain);
         const SeedsView seeds = moved.seeds();
         OfCpp& own = found[rank];
         own.ids.assign(moved.ids().begin(), moved.ids().end());
         own.positions.assign(seeds.positions.begin(), seeds.positions.end());
         own.weights.assign(seeds.weights.begin(), seeds.weights.end());
         own.there = compute_distributed(communicator, test_device(), domain, moved.ids(), seeds);
         own.local = local_diagram(communicator, test_device(), domain, moved.ids(), seeds, own.there);
         own.back = moved.send_back(own.there);
       }))
    if (thrown) std::rethrow_exception(thrown);
  return found;
}

void check_same(const pc_local_diagram& local, LocalDiagram& expected) {
  CHECK(same_bits(local.ids, local.id_count, expected.ids));
  CHECK(same_bits(local.cells, local.cell_count, expected.cells));
  const pc_joined_cells* shapes = nullptr;
  REQUIRE(pc_diagram_joined_view(local.diagram, &shapes) == PC_OK);
  const JoinedCells& joined = expected.diagram.joined();
  CHECK(same_bits(shapes->vertices, joined.vertices.size(), joined.vertices));
  CHECK(same_bits(shapes->loop, shapes->loop_count, joined.loop));
  const pc_measures* measures = nullptr;
  REQUIRE(pc_diagram_measures_view(local.diagram, &measures) == PC_OK);
  CHECK(same_bits(measures->mass, measures->count, expected.diagram.measures().mass));
  pc_diagram_destroy(local.diagram);  // does nothing
  REQUIRE(pc_diagram_measures_view(local.diagram, &measures) == PC_OK);
}

/// Shares out, computes, makes shapes and sends back, on a rank of C.
void check_shapes_of_rank(Rank& rank, const pc_domain& domain, const Shares& shares, OfCpp& expected,
                          std::mutex& one) {
  Arguments given(rank, domain, shares);
  Seeds moved;
  REQUIRE(pc_redistributed_seeds_create(&given.communicator, shares.dimension, given.ids, given.positions,
                                        given.weights, given.count, &domain, &moved.handle) == PC_OK);
  Arguments here = given;
  here.ids = moved->ids;
  here.positions = moved->positions;
  here.weights = moved->weights;
  here.count = moved->count;
  Cells cells, back;
  REQUIRE(here.compute(&cells.handle) == PC_OK);
  Local local;
  REQUIRE(pc_local_diagram_create(&here.communicator, here.device, &domain, here.ids, here.positions,
                                  here.weights, here.count, cells.handle, nullptr, &local.handle) == PC_OK);
  given.communicator.exchange = nullptr;  // of which the seeds have a copy
  REQUIRE(pc_redistributed_seeds_send_back(moved.handle, cells.handle, &back.handle) == PC_OK);
  const std::lock_guard lock(one);
  CHECK(moved->dimension == shares.dimension);
  CHECK(same_bits(moved->ids, moved->count, expected.ids));
  CHECK(same_bits(moved->positions, moved->count * static_cast<std::size_t>(moved->dimension),
                  expected.positions));
  CHECK(same_bits(moved->weights, moved->count, expected.weights));
  check_same(*cells.handle, expected.there);
  check_same(*back.handle, expected.back);
  check_same(*local.handle, *expected.local);
}

}  // namespace

TEST_CASE("ranks from C: shapes of cells, of seeds that were shared out anew, are those of C++") {
  INFO(replay_hint());
  Random random(test_seed());
  const std::array low{0.0, 0.0}, high{1.0, 1.0};
  for (const NamedDomain& named :
       std::vector<NamedDomain>{{"cube", unit_box(3)},
                                {"periodic square", Domain::periodic_box(low, high)},
                                {"islands", Domain::polygon(islands())}}) {
    INFO(named.name);
    const SeedArray seeds = seeds_for(named.domain, Distribution::white, WeightRange::W2, 150, random);
    for (const Shares& shares :
         {at_random(seeds, 3, random), Shares(seeds, std::vector<std::size_t>(150, 1), 2)}) {
      std::vector<OfCpp> expected = shapes_of_cpp(named.domain, shares);
      const pc_domain domain(named.domain);
      std::mutex one;
      on_c_ranks(shares.ids.size(), [&](Rank& rank) {
        check_shapes_of_rank(rank, domain, shares, expected[static_cast<std::size_t>(rank.threads.rank())],
                             one);
      });
    }
  }
}

}  // namespace powercell::c_ranks_test
