#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <powercell/error.hpp>
#include <powercell/local_diagram.hpp>
#include <string>
#include <unordered_map>
#include <utility>

#include "lib/base/float_environment.hpp"
#include "lib/base/rank_mailbox.hpp"
#include "lib/exchange/checks.hpp"

namespace powercell {
namespace exchange {
namespace {

/// Seeds with their ids, in any order.
struct NamedSeeds {
  std::size_t d;
  std::vector<std::uint64_t> ids;
  std::vector<double> positions, weights;

  void add(std::uint64_t id, const double* position, double weight) {
    ids.push_back(id);
    positions.insert(positions.end(), position, position + d);
    weights.push_back(weight);
  }
  void add(const NamedSeeds& others, std::size_t k) {
    add(others.ids[k], &others.positions[k * d], others.weights[k]);
  }
};

/// The seeds of this rank that have a cell.
NamedSeeds seeds_with_cells(const ShardSeeds& own, const Measures& measures) {
  const SeedsView& seeds = own.seeds;
  NamedSeeds found{static_cast<std::size_t>(seeds.dimension), {}, {}, {}};
  for (std::size_t i = 0; i < own.ids.size(); ++i)
    if (measures.status[i] == SeedStatus::ok)
      found.add(own.ids[i], &seeds.positions[i * found.d], seeds.weights.empty() ? 0 : seeds.weights[i]);
  return found;
}

/// The neighbours, in `cells`, of the seeds that have a cell by `measures`, without these, ascending.
std::vector<std::uint64_t> neighbors_besides(const NamedSeeds& here, const Measures& measures,
                                             const DistributedCells& cells) {
  std::vector<std::uint64_t> wanted, known = here.ids, others;
  for (std::size_t i = 0; i < measures.status.size(); ++i)
    if (measures.status[i] == SeedStatus::ok)
      wanted.insert(wanted.end(), cells.neighbor.begin() + static_cast<std::ptrdiff_t>(cells.offset[i]),
                    cells.neighbor.begin() + static_cast<std::ptrdiff_t>(cells.offset[i + 1]));
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  std::sort(known.begin(), known.end());
  std::set_difference(wanted.begin(), wanted.end(), known.begin(), known.end(), std::back_inserter(others));
  return others;
}

/// Ties between bisectors go by the order of seeds, which must be that of their ids.
NamedSeeds ascending(const NamedSeeds& seeds) {
  std::vector<std::size_t> order(seeds.ids.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return seeds.ids[a] < seeds.ids[b]; });
  NamedSeeds sorted{seeds.d, {}, {}, {}};
  for (const std::size_t k : order) sorted.add(seeds, k);
  return sorted;
}

/// \param all  ascending
std::vector<std::uint32_t> places(const std::vector<std::uint64_t>& ids,
                                  const std::vector<std::uint64_t>& all) {
  std::vector<std::uint32_t> places;
  for (const std::uint64_t id : ids)
    places.push_back(static_cast<std::uint32_t>(std::lower_bound(all.begin(), all.end(), id) - all.begin()));
  return places;
}

/// Who asks for a seed knows its id alone, so each is known where its id says.
/// \pre called on all ranks
class Directory {
 public:
  Directory(const NamedSeeds& own, Mailbox& mailbox) : mailbox_(mailbox), known_{own.d, {}, {}, {}} {
    std::map<int, NamedSeeds> sent;
    for (std::size_t k = 0; k < own.ids.size(); ++k)
      sent.try_emplace(meeting_shard(own.ids[k], mailbox.shards()), NamedSeeds{own.d, {}, {}, {}})
          .first->second.add(own, k);
    Mailbox::Letters letters;
    for (const auto& [to, seeds] : sent) letters[to] = packed(seeds.ids, seeds.positions, seeds.weights);
    NamedSeeds received{own.d, {}, {}, {}};
    for (const auto& [from, letter] : mailbox.deliver_one(std::move(letters))) {
      unpack(letter, received.ids, received.positions, received.weights);
      for (std::size_t k = 0; k < received.ids.size(); ++k) {
        place_[received.ids[k]] = known_.ids.size();
        known_.add(received, k);
      }
    }
  }

  /// Adds the seeds of these ids.
  /// \throw Error invalid_argument if nobody has one
  void look_up(const std::vector<std::uint64_t>& wanted, NamedSeeds& seeds) {
    std::map<int, std::vector<std::uint64_t>> asked;
    for (const std::uint64_t id : wanted) asked[meeting_shard(id, mailbox_.shards())].push_back(id);
    Mailbox::Letters letters;
    for (const auto& [to, ids] : asked) letters[to] = packed(ids);
    NamedSeeds answer{seeds.d, {}, {}, {}};
    letters = mailbox_.deliver_one(answers_to(mailbox_.deliver_one(std::move(letters))));
    for (const auto& [from, letter] : letters) {
      unpack(letter, answer.ids, answer.positions, answer.weights);
      for (std::size_t k = 0; k < answer.ids.size(); ++k) seeds.add(answer, k);
    }
  }

 private:
  Mailbox::Letters answers_to(const Mailbox::Letters& questions) const {
    Mailbox::Letters letters;
    std::vector<std::uint64_t> ids;
    for (const auto& [from, letter] : questions) {
      unpack(letter, ids);
      NamedSeeds answer{known_.d, {}, {}, {}};
      for (const std::uint64_t id : ids) {
        const auto place = place_.find(id);
        if (place == place_.end())
          throw Error(ErrorCode::invalid_argument,
                      "seed " + std::to_string(id) +
                          " is a neighbour, but no rank has it with a cell; give the seeds and cells of one "
                          "call on all ranks");
        answer.add(known_, place->second);
      }
      letters[from] = packed(answer.ids, answer.positions, answer.weights);
    }
    return letters;
  }

  Mailbox& mailbox_;
  NamedSeeds known_;
  std::unordered_map<std::uint64_t, std::size_t> place_;  // by id: in known_
};

void require_rows(const Domain& domain, const ShardSeeds& own, const DistributedCells& cells) {
  check_sizes(own.seeds, domain.dimension());
  const std::size_t n = own.ids.size();
  if (own.seeds.size() != n || cells.measures.status.size() != n || cells.offset.size() != n + 1 ||
      cells.offset.back() != cells.neighbor.size())
    throw Error(ErrorCode::invalid_argument,
                std::to_string(n) + " ids, " + std::to_string(own.seeds.size()) + " seeds and " +
                    std::to_string(cells.measures.status.size()) + " cells are not of one call");
}

/// A box around the domain. A cell may end at a bisector that the domain nowhere reaches, so that the walls
/// within it do not tell all seeds that the cell depends on. In a convex domain they do.
Domain surrounding_box(const Domain& domain) {
  const auto d = static_cast<std::size_t>(domain.dimension());
  const std::array<double, 3> low = domain.low(), high = domain.high();
  return Domain::box(std::span(low).first(d), std::span(high).first(d));
}

}  // namespace
}  // namespace exchange

LocalDiagram local_diagram(Communicator& communicator, const Device& device, const Domain& domain,
                           std::span<const std::uint64_t> ids, const SeedsView& seeds,
                           const DistributedCells& cells, const Options& options) {
  const FloatEnvironment environment;
  RankMailbox mailbox(communicator);
  return mailbox.together([&] {
    const exchange::ShardSeeds own{ids, seeds};
    exchange::require_rows(domain, own, cells);
    std::optional<DistributedCells> in_box;
    if (domain.region_count() > 1)
      in_box = mailbox.nested([&] {
        return compute_distributed(communicator, device, exchange::surrounding_box(domain), ids, seeds,
                                   {options});
      });
    const DistributedCells& around = in_box ? *in_box : cells;
    const exchange::NamedSeeds here = exchange::seeds_with_cells(own, cells.measures);
    exchange::NamedSeeds all = here;
    exchange::Directory(exchange::seeds_with_cells(own, around.measures), mailbox)
        .look_up(exchange::neighbors_besides(here, cells.measures, around), all);
    all = exchange::ascending(all);
    LocalDiagram made{Diagram(device, domain, options), all.ids, exchange::places(here.ids, all.ids)};
    made.diagram.set_seeds({domain.dimension(), all.positions, all.weights});
    if (!all.ids.empty()) made.diagram.select(made.cells);
    return made;
  });
}

}  // namespace powercell
