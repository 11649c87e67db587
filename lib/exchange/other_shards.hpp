/// \file
/// What a shard knows of the seeds of the others.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "lib/exchange/coarse_tree.hpp"
#include "lib/exchange/cut_test.hpp"
#include "lib/exchange/translations.hpp"
#include "lib/exchange/tree_of_boxes.hpp"
#include "lib/exchange/tree_walk.hpp"

namespace powercell::exchange {

/// What all shards tell all others at first, with a tree over these, so that far ones cost nothing.
class FirstCoarseTrees {
 public:
  /// \param coarse_tree  by shard, of all its seeds; one without levels if it has none
  FirstCoarseTrees(std::vector<PackedTree> coarse_tree, int dimension);

  std::size_t shards() const { return coarse_tree_.size(); }
  const PackedTree& of(int shard) const { return coarse_tree_[static_cast<std::size_t>(shard)]; }
  /// The lowest level has the boxes of shards that have seeds.
  const PackedTree& tree() const { return tree_; }
  /// Of a node of that level.
  int shard(std::uint32_t node) const { return shard_[node]; }

 private:
  std::vector<PackedTree> coarse_tree_;
  std::vector<int> shard_;
  PackedTree tree_;
};

/// The coarse trees that one shard has of the others.
class OtherShards {
 public:
  /// \param self  the shard that has them
  explicit OtherShards(int self) : self_(self) {}
  int self() const { return self_; }

  void meet(std::shared_ptr<const FirstCoarseTrees> first) { first_ = std::move(first); }
  const FirstCoarseTrees& first() const { return *first_; }
  int dimension() const { return first_->tree().dimension; }
  /// A finer coarse tree of all seeds of a shard.
  void take_coarse_tree(int shard, PackedTree&& coarse_tree) { finer_[shard] = std::move(coarse_tree); }
  /// A coarse tree of those that it has not sent.
  void take_unsent(int shard, PackedTree&& unsent) { unsent_[shard] = std::move(unsent); }

  /// The finest coarse tree of all seeds of a shard.
  const PackedTree& all_of(int shard) const { return found(finer_, shard, first_->of(shard)); }
  /// The finest coarse tree of those that it has not sent.
  const PackedTree& unsent_of(int shard) const { return found(unsent_, shard, all_of(shard)); }

  /// Calls use(shard) for the shards whose first box, with all boxes above it, is open(tree, number), until
  /// it returns false.
  template <class Open, class Use>
  void visit(const Open& open, const Use& use) const {
    const PackedTree& tree = first_->tree();
    visit_leaves(
        tree, [&](std::uint32_t number) { return open(tree, number); },
        [&](std::uint32_t node) {
          const int shard = first_->shard(node);
          return shard == self_ || use(shard);
        });
  }

 private:
  static const PackedTree& found(const std::map<int, PackedTree>& in, int shard, const PackedTree& other) {
    const auto at = in.find(shard);
    return at == in.end() ? other : at->second;
  }

  int self_;
  std::shared_ptr<const FirstCoarseTrees> first_;
  std::map<int, PackedTree> finer_, unsent_;
};

/// The boxes of coarse trees that could cut a cell.
class NearBoxes {
 public:
  /// A cell seen from the seeds of a shard.
  struct View {
    int shard = 0;
    std::size_t move = 0;  ///< number of the translation of the cell
    friend bool operator==(const View&, const View&) = default;
  };

  /// \param moves  of cells (translations()); must last as long
  NearBoxes(const OtherShards& others, const std::vector<Point>& moves) : others_(others), moves_(moves) {}

  /// Whether there are boxes for a cell of a seed in the box, which is not moved.
  /// \param farthest  that reaches as far as any, of a seed as light and as far from the origin as any
  bool may_meet(const BoxView& box, const CutTest& farthest) const;
  /// Whether there are boxes for a cell.
  /// \param seed  its row
  /// \param radius  as of CutTest
  bool may_meet(const double* seed, double radius) const;
  /// Finds the boxes for a cell.
  void set(const double* seed, double radius);
  bool empty() const { return groups_.empty(); }
  /// Whether there are few.
  bool few() const { return complete_; }
  /// Lists the shards that could cut off a point of that cell, or touch it.
  /// \param y  from the seed
  void views_at(const Point& y, std::vector<View>& views);
  /// Whether seeds that a shard has not sent could cut off a point of that cell.
  bool may_cut_at(const View& view, const Point& y);
  /// The row of that cell's seed as the shard sees it.
  std::array<double, 4> row(const View& view) const;

 private:
  static constexpr std::size_t most_boxes = 96;  // more are searched from the roots
  /// Whether a coarse tree has a leaf that, like all nodes above it, is open(tree, number).
  template <class Open>
  bool has_box(const Open& open) const;

  /// Boxes of a shard.
  struct Group {
    View view;
    CutTest cell;
    std::size_t end;  ///< in box_
  };

  const OtherShards& others_;
  const std::vector<Point>& moves_;
  std::array<double, 4> seed_{};
  std::vector<Group> groups_;
  std::vector<std::uint32_t> box_;  // nodes of the coarse tree of their shard
  bool complete_ = true;            // whether box_ has all boxes
};

}  // namespace powercell::exchange
