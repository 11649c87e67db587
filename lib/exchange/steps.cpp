#include "lib/exchange/steps.hpp"

#include <memory>
#include <utility>

namespace powercell::exchange {
namespace {

Bytes packed_outline(const PackedTree& outline) {
  const std::vector<std::uint64_t> sizes{static_cast<std::uint64_t>(outline.dimension), outline.seeds};
  return packed(sizes, outline.level_offset, outline.low, outline.high, outline.weight);
}

PackedTree outline_from(const Bytes& bytes) {
  PackedTree outline;
  std::vector<std::uint64_t> sizes;
  unpack(bytes, sizes, outline.level_offset, outline.low, outline.high, outline.weight);
  outline.dimension = static_cast<int>(sizes.at(0));
  outline.seeds = sizes.at(1);
  return outline;
}

}  // namespace

Steps::Steps(Diagram::State& diagram, std::span<const ShardSeeds> here, Post& post, const Guess& guess)
    : diagram_(diagram), post_(post) {
  const int first = post.first(), dimension = diagram.setup.domain.dimension();
  shards_.reserve(here.size());
  for (const ShardSeeds& seeds : here)
    shards_.emplace_back(first + static_cast<int>(shards_.size()), seeds.ids, seeds.seeds, dimension,
                         diagram.setup.options.threads, diagram.setup.domain.mesh().period.get());
  for (Shard& shard : shards_) shard.set_hidden_aside(diagram.setup);
  share_boxes();
  fetch_outlines();
  fetch_rims(guess);
}

void Steps::share_boxes() {
  std::vector<Bytes> own;
  for (const Shard& shard : shards_) {
    const PackedTree box = shard.own().box();
    report_.outlines += outline_bytes(box) * (static_cast<std::size_t>(post_.shards()) - 1);
    own.push_back(packed_outline(box));
  }
  std::vector<PackedTree> boxes;
  for (const Bytes& of_shard : post_.share(std::move(own))) boxes.push_back(outline_from(of_shard));
  const auto outlines = std::make_shared<FirstOutlines>(std::move(boxes), diagram_.setup.domain.dimension());
  for (Shard& shard : shards_) shard.meet(outlines);
}

void Steps::fetch_outlines() {
  std::vector<Post::Letters> letters(shards_.size());
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (const auto& [to, part] : shards_[s].near_parts()) letters[s][to] = packed(std::vector{part});
  letters = post_.deliver(std::move(letters));
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (auto& [from, letter] : letters[s]) {
      std::vector<NearPart> part;
      unpack(letter, part);
      const PackedTree outline = shards_[s].own().outline(from, part.at(0));
      report_.outlines += sizeof(NearPart) + outline_bytes(outline);
      letter = packed_outline(outline);
    }
  letters = post_.deliver(std::move(letters));
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (auto& [from, letter] : letters[s]) shards_[s].take(from, outline_from(std::exchange(letter, {})));
}

void Steps::fetch_rims(const Guess& guess) {
  std::vector<Post::Letters> letters(shards_.size());
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (const auto& [to, rim] : guess(shards_[s]))
      letters[s][to] = packed(rim.spacing, rim.seed, std::vector{rim.all}, std::vector{rim.lightest});
  letters = post_.deliver(std::move(letters));
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (auto& [from, letter] : letters[s]) {
      Rim rim;
      std::vector<std::uint64_t> all;
      std::vector<double> lightest;
      unpack(letter, rim.spacing, rim.seed, all, lightest);
      rim.all = all.at(0);
      rim.lightest = lightest.at(0);
      const Halo halo = shards_[s].own().near(from, rim);
      report_.requests += rim.bytes();
      report_.replies += halo.bytes();
      report_.outlines += outline_bytes(halo.rest);
      letter = packed(halo.id, halo.seed, packed_outline(halo.rest));
    }
  letters = post_.deliver(std::move(letters));
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (auto& [from, letter] : letters[s]) {
      Halo halo;
      Bytes rest;
      unpack(std::exchange(letter, {}), halo.id, halo.seed, rest);
      halo.rest = outline_from(rest);
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
  const std::vector<std::uint64_t> sum = post_.sums(open);
  return !sum.empty() && sum[0] > 0;
}

Post::Letters Steps::answers(std::size_t s, Post::Letters& requests) {
  Post::Letters replies;
  for (auto& [from, letter] : requests) {
    Request request;
    unpack(std::exchange(letter, {}), request.cell, request.end, request.vertex);
    const Reply reply = shards_[s].own().answer(from, request);
    report_.vertices += reply.found.size();
    report_.requests += request.bytes();
    report_.replies += reply.bytes();
    report_.outlines += outline_bytes(reply.outline);
    replies[from] = packed(reply.id, reply.seed, reply.found, packed_outline(reply.outline));
  }
  return replies;
}

void Steps::round() {
  ++report_.rounds;
  std::vector<Post::Letters> letters(shards_.size());
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (const auto& [to, request] : shards_[s].clip(diagram_))
      letters[s][to] = packed(request.cell, request.end, request.vertex);
  letters = post_.deliver(std::move(letters));
  for (std::size_t s = 0; s < shards_.size(); ++s) letters[s] = answers(s, letters[s]);
  letters = post_.deliver(std::move(letters));
  for (std::size_t s = 0; s < shards_.size(); ++s) {
    for (const auto& [from, letter] : letters[s]) {
      Reply reply;
      Bytes outline;
      unpack(letter, reply.id, reply.seed, reply.found, outline);
      reply.outline = outline_from(outline);
      shards_[s].take(from, std::move(reply));
    }
    shards_[s].settle();
  }
}

void Steps::end_hidden() {
  std::vector<Post::Letters> letters(shards_.size());
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (const auto& [to, hidden] : shards_[s].own().take_hidden()) {
      report_.ending += bytes_of(hidden);
      letters[s][to] = packed(hidden);
    }
  letters = post_.deliver(std::move(letters));
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
  std::vector<std::map<int, Twins>> questions;
  std::vector<Post::Letters> letters;
  for (const Shard& shard : shards_) {
    questions.push_back(shard.twins());
    Post::Letters& of_shard = letters.emplace_back();
    for (const auto& [to, twins] : questions.back()) {
      report_.ending += twins.bytes();
      of_shard[to] = packed(twins.id, twins.seed);
    }
  }
  letters = post_.deliver(std::move(letters));
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (auto& [from, letter] : letters[s]) {
      Twins twins;
      unpack(letter, twins.id, twins.seed);
      const std::vector<std::uint8_t> better = shards_[s].own().better_twins(twins);
      report_.ending += bytes_of(better);
      letter = packed(better);
    }
  letters = post_.deliver(std::move(letters));
  std::vector<std::uint8_t> better;
  for (std::size_t s = 0; s < shards_.size(); ++s)
    for (const auto& [from, letter] : letters[s]) {
      unpack(letter, better);
      shards_[s].mark_duplicates(questions[s].at(from), better);
    }
}

}  // namespace powercell::exchange
