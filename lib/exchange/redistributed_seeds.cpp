#include <cmath>
#include <powercell/error.hpp>
#include <powercell/redistributed_seeds.hpp>
#include <string>

#include "lib/base/float_environment.hpp"
#include "lib/base/mailbox.hpp"
#include "lib/base/rank_mailbox.hpp"
#include "lib/base/threads.hpp"
#include "lib/exchange/redistribution.hpp"

namespace powercell {
namespace exchange {
namespace {

void require_sendable(const ShardSeeds& own, const Domain* domain, Mailbox& mailbox) {
  const int d = own.seeds.dimension;
  if (d != 2 && d != 3)
    throw Error(ErrorCode::invalid_argument, "seeds have 2 or 3 coordinates, not " + std::to_string(d));
  if (domain != nullptr && domain->dimension() != d)
    throw Error(ErrorCode::invalid_argument, "seeds of " + std::to_string(d) +
                                                 " coordinates in a domain of " +
                                                 std::to_string(domain->dimension()));
  check_sizes(own.seeds, d);
  if (own.ids.size() != own.seeds.size())
    throw Error(ErrorCode::invalid_argument,
                std::to_string(own.ids.size()) + " ids for " + std::to_string(own.seeds.size()) + " seeds");
  require_same({{"the dimension of the seeds", static_cast<std::uint64_t>(d)}}, mailbox);
  for (std::size_t k = 0; k < own.seeds.positions.size(); ++k)
    if (!std::isfinite(own.seeds.positions[k]))
      refuse_seed(own.ids[k / static_cast<std::size_t>(d)], "its position is not finite");
}

}  // namespace
}  // namespace exchange

struct RedistributedSeeds::State {
  RankMailbox mailbox;
  exchange::Redistribution moved;

  State(Communicator& communicator, const exchange::ShardSeeds& own, const Domain* domain)
      : mailbox(communicator), moved(mailbox.together([&] {
          exchange::require_sendable(own, domain, mailbox);
          return exchange::Redistribution(own, own.seeds.dimension, thread_count(0), mailbox,
                                          domain == nullptr ? nullptr : domain->mesh().period.get());
        })) {}
};

RedistributedSeeds::RedistributedSeeds(Communicator& communicator, std::span<const std::uint64_t> ids,
                                       const SeedsView& seeds, const Domain* domain) {
  const FloatEnvironment environment;
  state_ = std::make_unique<State>(communicator, exchange::ShardSeeds{ids, seeds}, domain);
}

RedistributedSeeds::RedistributedSeeds(RedistributedSeeds&&) noexcept = default;
RedistributedSeeds& RedistributedSeeds::operator=(RedistributedSeeds&&) noexcept = default;
RedistributedSeeds::~RedistributedSeeds() = default;

std::span<const std::uint64_t> RedistributedSeeds::ids() const {
  return state_->moved.seeds().ids;
}

SeedsView RedistributedSeeds::seeds() const {
  return state_->moved.seeds().seeds;
}

DistributedCells RedistributedSeeds::send_back(const DistributedCells& cells) {
  const FloatEnvironment environment;
  return state_->mailbox.together([&] {
    const std::size_t rows = cells.measures.mass.size();
    if (rows != ids().size() || cells.offset.size() != rows + 1)
      throw Error(ErrorCode::invalid_argument,
                  std::to_string(rows) + " cells of " + std::to_string(ids().size()) + " seeds");
    DistributedCells own = state_->moved.send_back(cells);
    own.report = cells.report;
    return own;
  });
}

}  // namespace powercell
