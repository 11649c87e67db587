#include "lib/exchange/own_seeds.hpp"

#include <algorithm>
#include <numeric>
#include <powercell/error.hpp>
#include <string>
#include <utility>

#include "lib/base/positions.hpp"
#include "lib/base/threads.hpp"
#include "lib/exchange/answers.hpp"
#include "lib/exchange/boundary_leaves.hpp"
#include "lib/exchange/coarse_tree.hpp"
#include "lib/exchange/tree_walk.hpp"
#include "lib/exchange/unsent.hpp"
#include "lib/neighbors/hidden_seeds.hpp"

namespace powercell::exchange {
namespace {

/// Nodes of the lowest level of a coarse tree. That of the rest has lower ones at the boundary.
constexpr std::size_t coarse_nodes = 512;

/// The part with the seeds whose cells are asked about.
NearPart part_of(const Request& request, std::size_t d) {
  NearPart part{box_around(request.cell.data(), 1, d), request.cell[d]};
  for (std::size_t at = 0; at < request.cell.size(); at += d + 2) {
    extend(part.box, {&request.cell[at], &request.cell[at]}, d);
    part.lightest = std::min(part.lightest, request.cell[at + d]);
  }
  return part;
}

}  // namespace

OwnSeeds::OwnSeeds(std::span<const std::uint64_t> ids, const SeedsView& seeds, int dimension, int threads,
                   const Period* period)
    : threads_(thread_count(threads)), width_(static_cast<std::size_t>(dimension) + 1), id_(ids.size()) {
  if (ids.size() != seeds.size())
    throw Error(ErrorCode::invalid_argument, std::to_string(ids.size()) + " ids for " +
                                                 std::to_string(seeds.size()) + " seeds of a shard");
  if (!std::is_sorted(ids.begin(), ids.end())) {
    given_.resize(ids.size());
    std::iota(given_.begin(), given_.end(), std::size_t{0});
    std::sort(given_.begin(), given_.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  }
  const std::size_t d = width_ - 1;
  std::vector<double> positions(ids.size() * d), weights(ids.size());
  rows_.resize(ids.size() * width_);
  parallel_for(threads_for(size(), threads_), size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t k = given(i);
      id_[i] = ids[k];
      weights[i] = seeds.weights.empty() ? 0 : seeds.weights[k];
      copy_point(&seeds.positions[k * d], d, &positions[i * d]);
      copy_point(&seeds.positions[k * d], d, &rows_[i * width_]);
      rows_[i * width_ + d] = weights[i];
    }
  });
  if (period != nullptr) {
    wrap_all(*period, positions, threads_, positions);
    wrapped_rows_ = rows_;
    for (std::size_t i = 0; i < size(); ++i) copy_point(&positions[i * d], d, &wrapped_rows_[i * width_]);
  }
  const auto twice = std::adjacent_find(id_.begin(), id_.end());
  if (twice != id_.end())
    throw Error(ErrorCode::invalid_argument, "two seeds have the id " + std::to_string(*twice));
  hidden_.resize(id_.size());
  set_ = make_seed_set({dimension, positions, weights}, dimension, threads);
  tree_ = build_packed_tree(set_, threads);
  for (const std::uint32_t i : set_.duplicate) set_hidden(i);
}

void OwnSeeds::set_hidden_aside(const DiagramSetup& setup) {
  if (!may_hide_many(set_)) return;
  SeedBuffers buffers(setup.device.context());
  buffers.upload(setup.on_device.frame(), set_, tree_, threads_);
  const std::vector<std::uint8_t> hidden = hidden_seeds({setup.on_device, buffers, set_, tree_});
  SeedSet left = without_hidden(set_, hidden, threads_);
  if (left.size() == set_.size()) return;
  for (std::size_t rank = 0; rank < hidden.size(); ++rank)
    if (hidden[rank] != 0) set_hidden(set_.input[rank]);
  whole_ = Whole{std::exchange(set_, std::move(left)), std::move(tree_)};
  tree_ = build_packed_tree(set_, threads_);
}

PackedTree OwnSeeds::box() const {
  return coarse_tree_of(whole().tree, 1);
}

BoundaryLeaves OwnSeeds::boundary(const PackedTree& other, const std::vector<Point>& moves) const {
  return find_boundary_leaves(in_tree(), other, moves);
}

PackedTree OwnSeeds::coarse_tree(int asker, const NearPart& part) {
  sent_to(asker);
  const PackedTree& tree = whole().tree;
  return coarse_tree_of(tree, cut_near(tree, coarse_level(tree, coarse_nodes), part));
}

Halo OwnSeeds::near(int asker, const BoundaryLeaves& boundary) {
  Halo halo;
  if (set_.size() == 0 || boundary.leaves() == 0) return halo;
  const std::size_t d = width_ - 1;
  const TreeCut cut =
      cut_near(tree_, coarse_level(tree_, coarse_nodes),
               {box_around(boundary.seed.data(), boundary.leaves() * PackedTree::fan, d), boundary.lightest});
  Sent& sent = sent_to(asker);
  if (NearBoundary(in_tree()).is_everywhere(boundary)) {
    halo.unsent = coarse_tree_of(tree_, cut);
    return halo;
  }
  const std::vector<std::uint32_t> ranks = ranks_near(in_tree(), boundary, threads_);
  for (const std::uint32_t rank : ranks) {
    sent[rank] = 1;
    send(rank, halo.id, halo.seed);
  }
  halo.unsent = coarse_tree_of_unsent(in_tree(), cut, boundary, ranks);
  return halo;
}

void OwnSeeds::send(std::uint32_t rank, std::vector<std::uint64_t>& ids, std::vector<double>& rows) {
  ++sent_count_;
  const std::size_t i = set_.input[rank];
  ids.push_back(id_[i]);
  rows.insert(rows.end(), row(i), row(i) + width_);
}

Reply OwnSeeds::answer(int asker, const Request& request) {
  Reply reply;
  if (!sent_.contains(asker)) reply.coarse_tree = coarse_tree(asker, part_of(request, width_ - 1));
  Sent& sent = sent_to(asker);
  const auto may_send = [&](std::uint32_t rank) { return sent[rank] == 0 && hidden_[set_.input[rank]] == 0; };
  FirstSeeds first = first_seeds(in_tree(), request, may_send, threads_);
  reply.found = std::move(first.found);
  for (const std::uint32_t rank : first.rank) {
    if (sent[rank] != 0) continue;
    sent[rank] = 1;
    send(rank, reply.id, reply.seed);
  }
  return reply;
}

std::map<int, std::vector<std::uint64_t>> OwnSeeds::take_hidden() {
  std::map<int, std::vector<std::uint64_t>> ids;
  for (auto& [asker, sent] : sent_)
    for (std::uint32_t rank = 0; rank < sent.size(); ++rank) {
      if (sent[rank] != 1 || hidden_[set_.input[rank]] == 0) continue;
      sent[rank] = 2;
      ids[asker].push_back(id_[set_.input[rank]]);
    }
  return ids;
}

std::vector<std::uint8_t> OwnSeeds::better_duplicates(const Duplicates& duplicates) const {
  const TreeSeeds seeds = whole();
  const SeedSet& set = whole_ ? whole_->set : set_;
  const std::size_t d = seeds.dimension();
  std::vector<std::uint8_t> better(duplicates.id.size());
  for (std::size_t k = 0; k < better.size(); ++k) {
    const double* const row = &duplicates.seed[k * width_];
    visit_leaves(
        seeds.tree, [&](std::uint32_t node) { return contains(seeds.tree, node, row); },
        [&](std::uint32_t leaf) {
          for (std::size_t rank = seeds.first_of(leaf); rank < seeds.first_of(leaf + std::size_t{1});
               ++rank) {
            if (!std::equal(row, row + d, seeds.position(rank))) continue;
            const double weight = set.weights[rank];
            better[k] = weight > row[d] || (weight == row[d] && id_[set.input[rank]] < duplicates.id[k]);
            return false;  // there is no other at the same position
          }
          return true;
        });
  }
  return better;
}

}  // namespace powercell::exchange
