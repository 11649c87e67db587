#include <array>
#include <powercell/distributed.hpp>
#include <utility>

#include "lib/base/float_environment.hpp"
#include "lib/base/rank_post.hpp"
#include "lib/diagram/state.hpp"
#include "lib/exchange/checks.hpp"
#include "lib/exchange/redistribution.hpp"
#include "lib/exchange/steps.hpp"

namespace powercell {

Communicator::~Communicator() = default;

namespace exchange {
namespace {

DistributedCells cells_of(Diagram::State& diagram, const ShardSeeds& own, Post& post) {
  Steps steps(diagram, {&own, 1}, post);
  ShardCells cells = std::move(steps.run()[0]);
  return {std::move(cells.measures), std::move(cells.offset), std::move(cells.neighbor),
          std::move(cells.wall),     std::move(cells.shift),  steps.report()};
}

/// Adds the reports of all ranks.
ExchangeReport of_all(const ExchangeReport& own, Post& post) {
  using Member = std::uint64_t ExchangeReport::*;
  static constexpr std::array<Member, 9> members{
      &ExchangeReport::fetched,  &ExchangeReport::neighbors, &ExchangeReport::clipped,
      &ExchangeReport::vertices, &ExchangeReport::outlines,  &ExchangeReport::requests,
      &ExchangeReport::replies,  &ExchangeReport::ending,    &ExchangeReport::redistributed};
  std::vector<std::uint64_t> values;
  for (const Member member : members) values.push_back(own.*member);
  values = post.sums({values});
  ExchangeReport all = own;
  for (std::size_t k = 0; k < members.size(); ++k) all.*members[k] = values.at(k);
  return all;
}

DistributedCells compute(RankPost& post, const Device& device, const Domain& domain, const ShardSeeds& own,
                         DistributedOptions options) {
  require_same_call(domain, options, post);
  require_supported(domain, options.diagram);
  Diagram::State diagram(device, domain, options.diagram);
  require_valid(diagram.setup, {&own, 1}, post);
  DistributedCells cells;
  if (options.redistribute) {
    Redistribution moved(own, domain.dimension(), diagram.setup.threads, post, domain.mesh().period.get());
    const DistributedCells elsewhere = cells_of(diagram, moved.seeds(), post);
    cells = moved.send_back(elsewhere);
    cells.report = elsewhere.report;
    cells.report.redistributed = moved.bytes();
  } else {
    cells = cells_of(diagram, own, post);
  }
  cells.report = of_all(cells.report, post);
  return cells;
}

}  // namespace
}  // namespace exchange

DistributedCells compute_distributed(Communicator& communicator, const Device& device, const Domain& domain,
                                     std::span<const std::uint64_t> ids, const SeedsView& seeds,
                                     const DistributedOptions& options) {
  const FloatEnvironment environment;
  RankPost post(communicator);
  return post.together([&] { return exchange::compute(post, device, domain, {ids, seeds}, options); });
}

}  // namespace powercell
