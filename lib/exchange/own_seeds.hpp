/// \file
/// The seeds that a shard owns, and its answers to others.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <powercell/seeds.hpp>
#include <span>
#include <vector>

#include "lib/diagram/setup.hpp"
#include "lib/exchange/messages.hpp"
#include "lib/exchange/translations.hpp"
#include "lib/exchange/tree_seeds.hpp"
#include "lib/seeds/packed_tree.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell::exchange {

/// Seeds in ascending order of their ids, with a tree of those that are no duplicates of each other, and are
/// not known to be hidden by each other.
class OwnSeeds {
 public:
  /// \param ids     of the seeds, each once
  /// \param period  of the domain, null if it is not periodic
  /// \throw Error invalid_argument (sizes; an id that is there twice), invalid_seed
  OwnSeeds(std::span<const std::uint64_t> ids, const SeedsView& seeds, int dimension, int threads,
           const Period* period = nullptr);

  std::size_t size() const { return id_.size(); }
  std::uint64_t id(std::size_t i) const { return id_[i]; }
  /// The place of seed i among those given.
  std::size_t given(std::size_t i) const { return given_.empty() ? i : given_[i]; }
  /// Whether they were given in the order of their ids.
  bool given_in_order() const { return given_.empty(); }
  /// Rows of position and weight, as given.
  const double* row(std::size_t i) const { return &rows_[i * width_]; }
  /// The same with the wrapped position, as in the tree.
  const double* wrapped_row(std::size_t i) const {
    return wrapped_rows_.empty() ? row(i) : &wrapped_rows_[i * width_];
  }
  const PackedTree& tree() const { return tree_; }
  /// Sets seeds aside that are proved hidden among all, where they are many: they need no cells, and nobody
  /// needs to be sent them.
  /// \pre nothing was sent
  /// \throw Error as hidden_seeds
  void set_hidden_aside(const DiagramSetup& setup);
  /// Those that have a better one here at their position.
  std::span<const std::uint32_t> duplicates() const { return set_.duplicate; }
  /// The box of all seeds, those set aside too; without levels if there is none.
  PackedTree box() const;
  /// The seeds of a leaf of the tree.
  std::span<const std::uint32_t> in_leaf(std::size_t leaf) const {
    const std::size_t first = leaf * PackedTree::fan;
    return std::span(set_.input).subspan(first, std::min<std::size_t>(PackedTree::fan, set_.size() - first));
  }

  /// A seed without a cell: it cuts no other, and is not sent any more.
  void set_hidden(std::size_t i) { hidden_[i] = 1; }
  bool is_hidden(std::size_t i) const { return hidden_[i] != 0; }

  /// In the order of the tree.
  TreeSeeds in_tree() const { return {set_, tree_}; }

  /// The boundary towards another shard.
  /// \param other  its coarse tree
  /// \param moves  as of find_boundary_leaves
  BoundaryLeaves boundary(const PackedTree& other, const std::vector<Point>& moves) const;
  /// A coarse tree of all seeds for another shard.
  /// \param asker  its number
  /// \param part  where its seeds are
  /// \pre there are seeds
  PackedTree coarse_tree(int asker, const NearPart& part);
  /// The seeds near the boundary of another shard; none if that is everywhere.
  /// \param asker  its number
  /// \pre none were sent to it
  Halo near(int asker, const BoundaryLeaves& boundary);
  /// For each vertex the seed whose bisector is the first on the way from the cell's seed to the vertex; and
  /// a coarse tree, if the shard that asks has none.
  /// \param asker  its number
  Reply answer(int asker, const Request& request);
  /// By number of a shard: ids of hidden seeds that were sent to it, each once.
  std::map<int, std::vector<std::uint64_t>> take_hidden();
  /// Per seed of the question: 1 if a seed here at the same position is heavier, or as heavy with a lower id.
  std::vector<std::uint8_t> better_duplicates(const Duplicates& duplicates) const;
  /// Seeds sent to all others, counted once for each.
  std::uint64_t sent() const { return sent_count_; }

 private:
  /// All seeds but duplicates, where some of them were set aside.
  struct Whole {
    SeedSet set;
    PackedTree tree;
  };
  TreeSeeds whole() const { return whole_ ? TreeSeeds{whole_->set, whole_->tree} : in_tree(); }

  using Sent = std::vector<std::uint8_t>;  // by rank

  Sent& sent_to(int asker) {
    Sent& sent = sent_[asker];
    sent.resize(set_.size());
    return sent;
  }
  /// Appends a seed to a message.
  void send(std::uint32_t rank, std::vector<std::uint64_t>& ids, std::vector<double>& rows);

  int threads_;
  std::size_t width_;  // of a row
  std::vector<std::uint64_t> id_;
  std::vector<std::size_t> given_;           // empty if in order
  std::vector<double> rows_, wrapped_rows_;  // the latter empty if the domain is not periodic
  std::vector<std::uint8_t> hidden_;
  SeedSet set_;
  PackedTree tree_;
  std::optional<Whole> whole_;
  /// By number of the shards that have a coarse tree: 1 if sent, 2 if it was told too that the seed is
  /// hidden.
  std::map<int, Sent> sent_;
  std::uint64_t sent_count_ = 0;
};

}  // namespace powercell::exchange
