#include <powercell/c/redistributed_seeds.h>

#include <powercell/redistributed_seeds.hpp>

#include "lib/c_api/communicator.hpp"
#include "lib/c_api/distributed.hpp"
#include "lib/c_api/handles.hpp"

namespace powercell::c_api {
namespace {

/// What a pc_redistributed_seeds points into.
struct OwnedSeeds {
  std::unique_ptr<CallerCommunicator> ranks;  // that `moved` sends with
  std::unique_ptr<RedistributedSeeds> moved;
};

void fill_seeds(pc_redistributed_seeds& to, const OwnedSeeds& from) {
  const SeedsView seeds = from.moved->seeds();
  to.count = from.moved->ids().size();
  to.dimension = seeds.dimension;
  if (to.count == 0) return;
  to.ids = from.moved->ids().data();
  to.positions = seeds.positions.data();
  to.weights = seeds.weights.data();
}

/// The arguments of a call on one rank.
struct RedistributionCall {
  std::span<const std::uint64_t> ids;
  SeedsView seeds;
  const Domain* domain;
};

}  // namespace
}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

pc_status pc_redistributed_seeds_create(const pc_communicator* communicator, int dimension,
                                        const uint64_t* ids, const double* positions, const double* weights,
                                        size_t count, const pc_domain* domain,
                                        const pc_redistributed_seeds** seeds) {
  return guarded([&] {
    auto ranks = std::make_unique<CallerCommunicator>(communicator);
    const auto call = read_on_all(*ranks, [&] {
      (void)result_at(seeds);
      coordinates(dimension);
      return RedistributionCall{view(ids, count, "ids"), seeds_of(dimension, positions, weights, count),
                                domain ? &domain->domain : nullptr};
    });
    auto moved = std::make_unique<RedistributedSeeds>(*ranks, call.ids, call.seeds, call.domain);
    hand_over_result(seeds, OwnedSeeds{std::move(ranks), std::move(moved)}, fill_seeds);
  });
}

pc_status pc_redistributed_seeds_send_back(const pc_redistributed_seeds* seeds,
                                           const pc_distributed_cells* cells,
                                           const pc_distributed_cells** back) {
  return guarded([&] {
    const OwnedSeeds& from =
        static_cast<const Result<pc_redistributed_seeds, OwnedSeeds>&>(checked(seeds, "seeds")).owned;
    const DistributedCells* const sent = read_on_all(*from.ranks, [&] {
      (void)result_at(back);
      return &cells_in(cells);
    });
    hand_over_cells(back, from.moved->send_back(*sent));
  });
}

void pc_redistributed_seeds_destroy(const pc_redistributed_seeds* seeds) {
  destroy_result<OwnedSeeds>(seeds);
}
