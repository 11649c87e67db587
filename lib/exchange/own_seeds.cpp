#include "lib/exchange/own_seeds.hpp"

#include <algorithm>
#include <numeric>
#include <powercell/error.hpp>
#include <string>

#include "lib/base/threads.hpp"
#include "lib/exchange/outline.hpp"
#include "lib/exchange/rest.hpp"
#include "lib/exchange/rim.hpp"
#include "lib/exchange/tree_walk.hpp"

namespace powercell::exchange {
namespace {

/// Steps towards the seed of a cell; each is to a seed of lower power, so that few are taken.
constexpr int most_steps = 64;
/// A step must shorten the way by more than the rounding of a crossing.
constexpr double least_step = 1 - 1e-9;
/// So many are faster to test one by one than to find in the tree.
constexpr std::size_t few_leaves = 32;
/// Nodes of the level that an outline of the rest has far from what was sent.
constexpr std::size_t rest_nodes = 512;
/// Fewer are faster on one thread.
constexpr std::size_t least_shared = 2048 /* vertices */, least_shared_leaves = 512;

}  // namespace

OwnSeeds::OwnSeeds(std::span<const std::uint64_t> ids, const SeedsView& seeds, int dimension, int threads)
    : threads_(thread_count(threads)), width_(static_cast<std::size_t>(dimension) + 1), given_(ids.size()) {
  if (ids.size() != seeds.size())
    throw Error(ErrorCode::invalid_argument, std::to_string(ids.size()) + " ids for " +
                                                 std::to_string(seeds.size()) + " seeds of a shard");
  std::iota(given_.begin(), given_.end(), std::size_t{0});
  if (!std::is_sorted(ids.begin(), ids.end()))
    std::sort(given_.begin(), given_.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  const std::size_t d = width_ - 1;
  std::vector<double> positions(ids.size() * d), weights(ids.size());
  id_.resize(ids.size());
  rows_.resize(ids.size() * width_);
  for (std::size_t i = 0; i < given_.size(); ++i) {
    const std::size_t k = given_[i];
    id_[i] = ids[k];
    if (i > 0 && id_[i - 1] == id_[i])
      throw Error(ErrorCode::invalid_argument, "two seeds have the id " + std::to_string(ids[k]));
    weights[i] = seeds.weights.empty() ? 0 : seeds.weights[k];
    std::copy_n(&seeds.positions[k * d], d, &positions[i * d]);
    std::copy_n(&seeds.positions[k * d], d, &rows_[i * width_]);
    rows_[i * width_ + d] = weights[i];
  }
  hidden_.resize(id_.size());
  set_ = make_seed_set({dimension, positions, weights}, dimension, threads);
  tree_ = build_packed_tree(set_, threads);
}

void OwnSeeds::find_leaves(const CutTest& cell, Search& search) const {
  const auto d = static_cast<std::size_t>(set_.dimension);
  search.leaves.clear();
  search.few = true;
  visit_leaves(
      tree_,
      [&](std::uint32_t node) {
        return cell.may_meet(&tree_.low[node * d], &tree_.high[node * d], tree_.weight[node]);
      },
      [&](std::uint32_t leaf) {
        search.leaves.push_back(leaf);
        search.few = search.leaves.size() <= few_leaves;
        return search.few;
      });
}

std::uint32_t OwnSeeds::least(const CutTest& point, const Search& search) const {
  const auto d = static_cast<std::size_t>(set_.dimension);
  double limit = point.limit();
  std::uint32_t best = none;
  const auto key = [&](std::uint32_t node) {
    return point.power(&tree_.low[node * d], &tree_.high[node * d], tree_.weight[node]);
  };
  const auto look_into = [&](std::uint32_t leaf) {
    const std::uint32_t first = leaf * PackedTree::fan,
                        last = std::min(first + PackedTree::fan, static_cast<std::uint32_t>(set_.size()));
    for (std::uint32_t rank = first; rank < last; ++rank) {
      const double power = point.power(position(rank), set_.weights[rank]);
      if (power > limit || !may_send(rank, search.sent)) continue;
      limit = power;
      best = rank;
    }
  };
  if (!search.few) {
    visit_nearest(tree_, key, limit, look_into);
    return best;
  }
  for (const std::uint32_t leaf : search.leaves)
    if (!(key(leaf) > limit)) look_into(leaf);
  return best;
}

bool OwnSeeds::find_first(CutTest& point, const Search& search, std::vector<std::uint32_t>& ranks) const {
  std::uint32_t first = least(point, search);
  if (first == none) return false;
  const Point vertex = point.at();
  double along = 1;
  for (int step = 0; step < most_steps; ++step) {
    point.move_to(vertex);
    const double crossing = point.crossing(position(first), set_.weights[first]);
    if (!(crossing > 0) || !(crossing < along * least_step)) break;
    along = crossing;
    point.move_to({along * vertex[0], along * vertex[1], along * vertex[2]});
    const std::uint32_t next = least(point, search);
    if (next == none || next == first) break;
    // It may cut the cell on the side of the seed alone, if the seed is not in it. To leave it out and send
    // the one before would fetch more seeds: a fifth more of white seeds with weights W2.
    first = next;
  }
  ranks.push_back(first);
  return true;
}

void OwnSeeds::answer_cell(const Request& request, std::size_t cell, Search& search,
                           std::vector<std::uint8_t>& found, std::vector<std::uint32_t>& ranks) const {
  const auto d = static_cast<std::size_t>(set_.dimension);
  const double* const row = &request.cell[cell * (d + 2)];
  const double radius = row[d + 1];
  CutTest point(row, radius, set_.dimension);
  find_leaves(point, search);
  for (std::uint32_t v = cell == 0 ? 0 : request.end[cell - 1]; v < request.end[cell]; ++v) {
    Point y{};
    for (std::size_t k = 0; k < d; ++k) y[k] = radius * static_cast<double>(request.vertex[v * d + k]);
    point.move_to(y);
    if (find_first(point, search, ranks)) found[v] = 1;
  }
}

Rim OwnSeeds::rim(const PackedTree& other) const {
  return find_rim(set_, tree_, other);
}

Halo OwnSeeds::near(int asker, const Rim& rim) {
  Halo halo;
  if (set_.size() == 0) return halo;
  if (NearRim(set_, tree_).is_everywhere(rim)) {
    halo.rest = outline_of(tree_, rest_nodes);
    return halo;
  }
  std::vector<std::vector<std::uint32_t>> found(rim.leaves());
  parallel_for(threads_for(found.size(), threads_, least_shared_leaves), found.size(),
               [&](std::size_t begin, std::size_t end) {
                 NearRim near(set_, tree_);
                 for (std::size_t k = begin; k < end; ++k) near.find(rim, k, found[k]);
               });
  Sent& sent = sent_[asker];
  sent.resize(set_.size());
  for (const std::vector<std::uint32_t>& ranks : found)
    for (const std::uint32_t rank : ranks) sent[rank] = 1;
  std::vector<std::uint32_t> ranks;
  for (std::uint32_t rank = 0; rank < sent.size(); ++rank) {
    if (sent[rank] == 0) continue;
    ranks.push_back(rank);
    send(rank, halo.id, halo.seed);
  }
  halo.rest = outline_of_rest(set_, tree_, outline_level(tree_, rest_nodes), rim, ranks);
  return halo;
}

void OwnSeeds::send(std::uint32_t rank, std::vector<std::uint64_t>& ids, std::vector<double>& rows) {
  ++sent_count_;
  const std::size_t i = set_.input[rank];
  ids.push_back(id_[i]);
  rows.insert(rows.end(), row(i), row(i) + width_);
}

Reply OwnSeeds::answer(int asker, const Request& request) {
  Sent& sent = sent_[asker];
  sent.resize(set_.size());
  Reply reply;
  reply.found.resize(request.vertex.size() / static_cast<std::size_t>(set_.dimension));
  std::vector<std::vector<std::uint32_t>> found(request.cells());
  parallel_for(threads_for(reply.found.size(), threads_, least_shared), request.cells(),
               [&](std::size_t begin, std::size_t end) {
                 Search search{sent, {}};
                 for (std::size_t cell = begin; cell < end; ++cell)
                   answer_cell(request, cell, search, reply.found, found[cell]);
               });
  for (const std::vector<std::uint32_t>& ranks : found)
    for (const std::uint32_t rank : ranks) {
      if (sent[rank] != 0) continue;
      sent[rank] = 1;
      send(rank, reply.id, reply.seed);
    }
  return reply;
}

std::vector<std::uint64_t> OwnSeeds::take_hidden(int asker) {
  std::vector<std::uint64_t> ids;
  Sent& sent = sent_[asker];
  for (std::uint32_t rank = 0; rank < sent.size(); ++rank) {
    if (sent[rank] != 1 || hidden_[set_.input[rank]] == 0) continue;
    sent[rank] = 2;
    ids.push_back(id_[set_.input[rank]]);
  }
  return ids;
}

std::vector<std::uint8_t> OwnSeeds::better_twins(const Twins& twins) const {
  const auto d = static_cast<std::size_t>(set_.dimension);
  std::vector<std::uint8_t> better(twins.id.size());
  for (std::size_t k = 0; k < better.size(); ++k) {
    const double* const row = &twins.seed[k * width_];
    visit_leaves(
        tree_, [&](std::uint32_t node) { return contains(tree_, node, row); },
        [&](std::uint32_t leaf) {
          const std::uint32_t first = leaf * PackedTree::fan,
                              last =
                                  std::min(first + PackedTree::fan, static_cast<std::uint32_t>(set_.size()));
          for (std::uint32_t rank = first; rank < last; ++rank) {
            if (!std::equal(row, row + d, position(rank))) continue;
            const double weight = set_.weights[rank];
            better[k] = weight > row[d] || (weight == row[d] && id_[set_.input[rank]] < twins.id[k]);
            return false;  // there is no other at the same position
          }
          return true;
        });
  }
  return better;
}

}  // namespace powercell::exchange
