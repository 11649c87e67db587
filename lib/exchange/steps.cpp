#include "lib/exchange/steps.hpp"

#include <memory>
#include <utility>

namespace powercell::exchange {
namespace {

Bytes packed_coarse_tree(const PackedTree& coarse_tree) {
  const std::vector<std::uint64_t> sizes{static_cast<std::uint64_t>(coarse_tree.dimension),
                                         coarse_tree.seeds};
  return packed(sizes, coarse_tree.level_offset, coarse_tree.low, coarse_tree.high, coarse_tree.weight);
}

PackedTree coarse_tree_from(const Bytes& bytes) {
  PackedTree coarse_tree;
  std::vector<std::uint64_t> sizes;
  unpack(bytes, sizes, coarse_tree.level_offset, coarse_tree.low, coarse_tree.high, coarse_tree.weight);
  coarse_tree.dimension = static_cast<int>(sizes.at(0));
  coarse_tree.seeds = sizes.at(1);
  return coarse_tree;
}

}  // namespace

Steps::Steps(Diagram::State& diagram, std::span<const ShardSeeds> here, Mailbox& mailbox,
             const Estimate& estimate)
    : diagram_(diagram), mailbox_(mailbox) {
  const int first = mailbox.first(), dimension = diagram.setup.domain.dimension();
  shards_.reserve(here.size());
  for (const ShardSeeds& seeds : here)
    shards_.emplace_back(first + static_cast<int>(shards_.size()), seeds.ids, seeds.seeds, dimension,
                         diagram.setup.options.threads, diagram.setup.domain.mesh().period.get());
  for (Shard& shard : shards_) shard.set_hidden_aside(diagram.setup);
  share_boxes();
  fetch_coarse_trees();
  fetch_boundaries(estimate);
}

void Steps::share_boxes() {
  std::vector<Bytes> own;
  for (const Shard& shard : shards_) {
    const PackedTree box = shard.own().box();
    report_.outlines += coarse_tree_bytes(box) * (static_cast<std::size_t>(mailbox_.shards()) - 1);
    own.push_back(packed_coarse_tree(box));
  }
  std::vector<PackedTree> boxes;
  for (const Bytes& of_shard : mailbox_.share(std::move(own))) boxes.push_back(coarse_tree_from(of_shard));
  const auto coarse_trees =
      std::make_shared<FirstCoarseTrees>(std::move(boxes), diagram_.setup.domain.dimension());
  for (Shard& shard : shards_) shard.meet(coarse_trees);
}

void Steps::fetch_coarse_trees() {
  std::vector<Mailbox::Letters> letters(shards_.size());
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (const auto& [to, part] : shards_[s].near_parts()) letters[s][to] = packed(std::vector{part});
  letters = mailbox_.deliver(std::move(letters));
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (auto& [from, letter] : letters[s]) {
      std::vector<NearPart> part;
      unpack(letter, part);
      const PackedTree coarse_tree = shards_[s].own().coarse_tree(from, part.at(0));
      report_.outlines += sizeof(NearPart) + coarse_tree_bytes(coarse_tree);
      letter = packed_coarse_tree(coarse_tree);
    }
  letters = mailbox_.deliver(std::move(letters));
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (auto& [from, letter] : letters[s])
      shards_[s].take(from, coarse_tree_from(std::exchange(letter, {})));
}

void Steps::fetch_boundaries(const Estimate& estimate) {
  std::vector<Mailbox::Letters> letters(shards_.size());
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (const auto& [to, boundary] : estimate(shards_[s]))
      letters[s][to] =
          packed(boundary.spacing, boundary.seed, std::vector{boundary.all}, std::vector{boundary.lightest});
  letters = mailbox_.deliver(std::move(letters));
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (auto& [from, letter] : letters[s]) {
      BoundaryLeaves boundary;
      std::vector<std::uint64_t> all;
      std::vector<double> lightest;
      unpack(letter, boundary.spacing, boundary.seed, all, lightest);
      boundary.all = all.at(0);
      boundary.lightest = lightest.at(0);
      const Halo halo = shards_[s].own().near(from, boundary);
      report_.requests += boundary.bytes();
      report_.replies += halo.bytes();
      report_.outlines += coarse_tree_bytes(halo.unsent);
      letter = packed(halo.id, halo.seed, packed_coarse_tree(halo.unsent));
    }
  letters = mailbox_.deliver(std::move(letters));
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (auto& [from, letter] : letters[s]) {
      Halo halo;
      Bytes unsent;
      unpack(std::exchange(letter, {}), halo.id, halo.seed, unsent);
      halo.unsent = coarse_tree_from(unsent);
      shards_[s].take(from, std::move(halo));
    }
}

std::vector<ShardCells> Steps::run() {
  while (any_open()) {
    do round();
    while (any_open());
    end_hidden();
  }
  mark_duplicates();
  std::vector<ShardCells> cells;
  for (Shard& shard : shards_) {
    cells.push_back(shard.take_cells(diagram_.setup.domain.measure()));
    report_.clipped += shard.clipped_cells();
    report_.fetched += shard.foreign_seeds();
    report_.neighbors += shard.foreign_neighbors().size();
  }
  return cells;
}

bool Steps::any_open() {
  std::vector<std::vector<std::uint64_t>> open;
  for (const Shard& shard : shards_) open.push_back({shard.open_cells()});
  const std::vector<std::uint64_t> sum = mailbox_.sums(open);
  return !sum.empty() && sum[0] > 0;
}

Mailbox::Letters Steps::answers(std::size_t s, Mailbox::Letters& requests) {
  Mailbox::Letters replies;
  for (auto& [from, letter] : requests) {
    Request request;
    unpack(std::exchange(letter, {}), request.cell, request.end, request.vertex);
    const Reply reply = shards_[s].own().answer(from, request);
    report_.vertices += reply.found.size();
    report_.requests += request.bytes();
    report_.replies += reply.bytes();
    report_.outlines += coarse_tree_bytes(reply.coarse_tree);
    replies[from] = packed(reply.id, reply.seed, reply.found, packed_coarse_tree(reply.coarse_tree));
  }
  return replies;
}

void Steps::round() {
  ++report_.rounds;
  std::vector<Mailbox::Letters> letters(shards_.size());
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (const auto& [to, request] : shards_[s].clip(diagram_))
      letters[s][to] = packed(request.cell, request.end, request.vertex);
  letters = mailbox_.deliver(std::move(letters));
  for (std::size_t s = 0; s < shards_.size(); ++s) letters[s] = answers(s, letters[s]);
  letters = mailbox_.deliver(std::move(letters));
  for (std::size_t s = 0; s < shards_.size(); ++s) {
    for (const auto& [from, letter] : letters[s]) {
      Reply reply;
      Bytes coarse_tree;
      unpack(letter, reply.id, reply.seed, reply.found, coarse_tree);
      reply.coarse_tree = coarse_tree_from(coarse_tree);
      shards_[s].take(from, std::move(reply));
    }
    shards_[s].settle();
  }
}

void Steps::end_hidden() {
  std::vector<Mailbox::Letters> letters(shards_.size());
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (const auto& [to, hidden] : shards_[s].own().take_hidden()) {
      report_.ending += bytes_of(hidden);
      letters[s][to] = packed(hidden);
    }
  letters = mailbox_.deliver(std::move(letters));
  std::vector<std::uint64_t> hidden;
  for (std::size_t s = 0; s < shards_.size(); ++s) {
    for (const auto& [from, letter] : letters[s]) {
      unpack(letter, hidden);
      shards_[s].forget(hidden);
    }
    shards_[s].reopen();
  }
}

void Steps::mark_duplicates() {
  std::vector<std::map<int, Duplicates>> questions;
  std::vector<Mailbox::Letters> letters;
  for (const Shard& shard : shards_) {
    questions.push_back(shard.duplicates());
    Mailbox::Letters& of_shard = letters.emplace_back();
    for (const auto& [to, duplicates] : questions.back()) {
      report_.ending += duplicates.bytes();
      of_shard[to] = packed(duplicates.id, duplicates.seed);
    }
  }
  letters = mailbox_.deliver(std::move(letters));
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (auto& [from, letter] : letters[s]) {
      Duplicates duplicates;
      unpack(letter, duplicates.id, duplicates.seed);
      const std::vector<std::uint8_t> better = shards_[s].own().better_duplicates(duplicates);
      report_.ending += bytes_of(better);
      letter = packed(better);
    }
  letters = mailbox_.deliver(std::move(letters));
  std::vector<std::uint8_t> better;
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (const auto& [from, letter] : letters[s]) {
      unpack(letter, better);
      shards_[s].mark_duplicates(questions[s].at(from), better);
    }
}

}  // namespace powercell::exchange
