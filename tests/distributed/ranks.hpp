/// \file
/// Distributed computations whose ranks are threads.
#pragma once

#include <powercell/distributed.hpp>
#include <string>
#include <vector>

#include "tests/exchange/compare.hpp"
#include "tests/support/loopback.hpp"

namespace powercell::test {

/// The cells of each rank. \throw what the first rank threw that did
inline std::vector<DistributedCells> on_ranks(const Domain& domain, const Shares& shares,
                                              const DistributedOptions& options = {}) {
  const std::vector<exchange::ShardSeeds> view = shares.view();
  std::vector<DistributedCells> cells(view.size());
  for (const std::exception_ptr& thrown : on_ranks(view.size(), [&](Communicator& communicator) {
         const auto rank = static_cast<std::size_t>(communicator.rank());
         cells[rank] = compute_distributed(communicator, test_device(), domain, view[rank].ids,
                                           view[rank].seeds, options);
       }))
    if (thrown) std::rethrow_exception(thrown);
  return cells;
}

/// The cells of all ranks are those of one diagram. \return the report, which is the same on all
inline ExchangeReport check_ranks(Diagram& diagram, const Shares& shares,
                                  const DistributedOptions& options = {}) {
  const std::vector<DistributedCells> cells = on_ranks(diagram.domain(), shares, options);
  for (std::size_t rank = 0; rank < cells.size(); ++rank) {
    CAPTURE(rank);
    check_cells(diagram, shares.ids[rank], cells[rank]);
    CHECK(cells[rank].measures.dimension == shares.dimension);
    CHECK(cells[rank].measures.domain_measure == diagram.measures().domain_measure);
    CHECK(cells[rank].report.rounds == cells[0].report.rounds);
    CHECK(cells[rank].report.fetched == cells[0].report.fetched);
    CHECK(cells[rank].report.requests == cells[0].report.requests);
    CHECK(cells[rank].report.redistributed == cells[0].report.redistributed);
  }
  CHECK((cells[0].report.redistributed > 0) ==
        (options.redistribute && cells.size() > 1 && diagram.size() > 1));
  return cells[0].report;
}

}  // namespace powercell::test
