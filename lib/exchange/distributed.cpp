#include <array>
#include <powercell/distributed.hpp>
#include <utility>

#include "lib/base/float_environment.hpp"
#include "lib/base/rank_mailbox.hpp"
#include "lib/diagram/state.hpp"
#include "lib/exchange/checks.hpp"
#include "lib/exchange/redistribution.hpp"
#include "lib/exchange/steps.hpp"

namespace powercell {

Communicator::~Communicator() = default;

namespace exchange {
namespace {

DistributedCells cells_of(Diagram::State& diagram, const ShardSeeds& own, Mailbox& mailbox) {
  Steps steps(diagram, {&own, 1}, mailbox);
  ShardCells cells = std::move(steps.run()[0]);
  return {std::move(cells.measures), std::move(cells.offset), std::move(cells.neighbor),
          std::move(cells.wall),     std::move(cells.shift),  steps.report()};
}

/// Adds the reports of all ranks.
ExchangeReport of_all(const ExchangeReport& own, Mailbox& mailbox) {
  using Member = std::uint64_t ExchangeReport::*;
  static constexpr std::array<Member, 9> members{
      &ExchangeReport::fetched,  &ExchangeReport::neighbors, &ExchangeReport::clipped,
      &ExchangeReport::vertices, &ExchangeReport::outlines,  &ExchangeReport::requests,
      &ExchangeReport::replies,  &ExchangeReport::ending,    &ExchangeReport::redistributed};
  std::vector<std::uint64_t> values;
  for (const Member member : members) values.push_back(own.*member);
  values = mailbox.sums({values});
  ExchangeReport all = own;
  for (std::size_t k = 0; k < members.size(); ++k) all.*members[k] = values.at(k);
  return all;
}

DistributedCells compute(RankMailbox& mailbox, const Device& device, const Domain& domain,
                         const ShardSeeds& own, DistributedOptions options) {
  require_same_call(domain, options, mailbox);
  require_supported(domain, options.diagram);
  Diagram::State diagram(device, domain, options.diagram);
  require_valid(diagram.setup, {&own, 1}, mailbox);
  DistributedCells cells;
  if (options.redistribute) {
    Redistribution moved(own, domain.dimension(), diagram.setup.threads, mailbox, domain.mesh().period.get());
    const DistributedCells elsewhere = cells_of(diagram, moved.seeds(), mailbox);
    cells = moved.send_back(elsewhere);
    cells.report = elsewhere.report;
    cells.report.redistributed = moved.bytes();
  } else {
    cells = cells_of(diagram, own, mailbox);
  }
  cells.report = of_all(cells.report, mailbox);
  return cells;
}

}  // namespace
}  // namespace exchange

DistributedCells compute_distributed(Communicator& communicator, const Device& device, const Domain& domain,
                                     std::span<const std::uint64_t> ids, const SeedsView& seeds,
                                     const DistributedOptions& options) {
  const FloatEnvironment environment;
  RankMailbox mailbox(communicator);
  return mailbox.together([&] { return exchange::compute(mailbox, device, domain, {ids, seeds}, options); });
}

}  // namespace powercell
