#include "lib/out_of_core/other_seeds.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <queue>
#include <span>
#include <tuple>
#include <utility>

#include "lib/base/threads.hpp"
#include "lib/exchange/answers.hpp"
#include "lib/exchange/coarse_tree.hpp"
#include "lib/exchange/unsent.hpp"

namespace powercell::out_of_core {
namespace {

/// Nodes of a coarse tree far from the piece, and of that of the piece itself.
constexpr std::size_t coarse_nodes = 512;
/// What is nearer to a box of the piece's coarse tree than this part of its edge is in a coarse tree leaf by
/// leaf.
constexpr double near_part = 0.125;

/// The coarse tree of a piece, with the distance up to which seeds are near in the place of the weights.
PackedTree boundary_of(const PackedTree& own) {
  PackedTree boundary = exchange::coarse_tree_of(own, coarse_nodes);
  const auto d = static_cast<std::size_t>(boundary.dimension);
  for (std::uint32_t node = 0; node < boundary.weight.size(); ++node)
    boundary.weight[node] = near_part * exchange::longest_edge(exchange::box_of(boundary, node), d);
  return boundary;
}

/// Seeds that each piece gets, at most. One whose weight is far above those of others would else be asked for
/// by every cell of each piece, and none would be proved without its vertices.
constexpr std::size_t most_heavy = 32;

/// The square of the distance of seeds if they were spread evenly in their box.
double spacing2(const exchange::TreeSeeds& seeds) {
  const std::size_t d = seeds.dimension();
  const exchange::BoxView all =
      exchange::box_of(seeds.tree, static_cast<std::uint32_t>(seeds.tree.weight.size() - 1));
  double log_measure = -std::log(static_cast<double>(seeds.size()));
  for (std::size_t k = 0; k < d; ++k) log_measure += std::log(all.high[k] - all.low[k]);
  return std::exp(2 * log_measure / static_cast<double>(d));
}

/// The ranks of the seeds far heavier than all but a few, ascending.
std::vector<std::uint32_t> heaviest_of(const Store& store) {
  const exchange::TreeSeeds seeds = store.seeds();
  if (seeds.size() <= most_heavy) return {};
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heaviest;  // the lightest of them is on top
  for (std::size_t rank = 0; rank < seeds.size(); ++rank) {
    const double weight = seeds.weights[rank];
    const bool has_room = heaviest.size() <= most_heavy;
    if (!has_room && weight <= heaviest.top().first) continue;
    if (!has_room) heaviest.pop();
    heaviest.emplace(weight, static_cast<std::uint32_t>(rank));
  }
  store.drop();
  const double bound = heaviest.top().first + spacing2(seeds);
  std::vector<std::uint32_t> ranks;
  for (; !heaviest.empty(); heaviest.pop())
    if (heaviest.top().first > bound) ranks.push_back(heaviest.top().second);
  std::sort(ranks.begin(), ranks.end());
  return ranks;
}

}  // namespace

OtherSeeds::OtherSeeds(const Store& store, const Statuses& statuses, int threads)
    : store_(store),
      statuses_(statuses),
      threads_(thread_count(threads)),
      heaviest_(heaviest_of(store)),
      is_sent_(store.size()) {}

template <class Near>
PackedTree OtherSeeds::coarse_tree_without(const std::vector<std::uint32_t>& ranks, const Near& near) const {
  std::vector<std::uint32_t> out(last_ - first_);
  std::iota(out.begin(), out.end(), static_cast<std::uint32_t>(first_));
  const auto middle = std::lower_bound(ranks.begin(), ranks.end(), first_);
  out.insert(out.begin(), ranks.begin(), middle);
  out.insert(out.end(), middle, ranks.end());
  const exchange::TreeSeeds seeds = store_.seeds();
  const std::size_t level = exchange::coarse_level(seeds.tree, coarse_nodes);
  return exchange::coarse_tree_of_unsent(seeds, exchange::level_cut(seeds.tree, level), near, out);
}

PackedTree OtherSeeds::begin(std::size_t piece, const PackedTree& own) {
  for (const std::uint32_t rank : sent_) is_sent_[rank] = 0;
  sent_.clear();
  std::tie(first_, last_) = store_.ranks(piece);
  return coarse_tree_without({}, boundary_of(own));
}

void OtherSeeds::send(std::uint32_t rank, std::vector<std::uint64_t>& ids, std::vector<double>& rows) {
  if (is_sent_[rank] != 0) return;
  is_sent_[rank] = 1;
  sent_.push_back(rank);
  ++sent_count_;
  const exchange::TreeSeeds seeds = store_.seeds();
  ids.push_back(rank);
  rows.insert(rows.end(), store_.given(rank), store_.given(rank) + seeds.dimension());
  rows.push_back(seeds.weights[rank]);
}

exchange::Halo OtherSeeds::near(const exchange::BoundaryLeaves& boundary) {
  exchange::Halo halo;
  const std::vector<std::uint32_t> likely =
      exchange::ranks_near(store_.seeds(), boundary, threads_, {first_, last_});
  std::vector<std::uint32_t> ranks;
  std::set_union(likely.begin(), likely.end(), heaviest_.begin(), heaviest_.end(), std::back_inserter(ranks));
  std::erase_if(ranks, [this](std::uint32_t rank) { return is_own(rank); });
  for (const std::uint32_t rank : ranks)
    if (!statuses_.is_hidden(store_.id(rank))) send(rank, halo.id, halo.seed);
  // Hidden seeds cut nothing, so they need no box either.
  halo.unsent = coarse_tree_without(ranks, boundary);
  return halo;
}

exchange::Reply OtherSeeds::answer(const exchange::Request& request) {
  const auto may_send = [this](std::uint32_t rank) {
    return !is_own(rank) && is_sent_[rank] == 0 && !statuses_.is_hidden(store_.id(rank));
  };
  exchange::FirstSeeds first = exchange::first_seeds(store_.seeds(), request, may_send, threads_);
  exchange::Reply reply;
  reply.found = std::move(first.found);
  for (const std::uint32_t rank : first.rank) send(rank, reply.id, reply.seed);
  return reply;
}

}  // namespace powercell::out_of_core
