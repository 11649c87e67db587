/// \file
/// The seeds that may have cells, ready to be searched. Internal.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lib/diagram/input.hpp"
#include "lib/diagram/setup.hpp"
#include "lib/scene/scene.hpp"

namespace powercell {

/// The active seeds in their order, their tree, and both on the device. Stays where it is, since scenes and
/// plans refer to it.
class Active {
 public:
  /// Orders the seeds and sets aside those that a search finds hidden, if they are many.
  /// \param buffers  those that the seeds go to; must outlive this
  /// \param tree     of an earlier one for the same positions: used unless that had set seeds aside
  Active(const Setup& setup, const Input& input, SeedBuffers& buffers, std::optional<PackedTree> tree);
  Active(const Active&) = delete;
  Active& operator=(const Active&) = delete;

  const SeedSet& seeds() const { return own_ ? *own_ : input_.seeds; }
  const PackedTree& tree() const { return tree_; }
  Scene scene() const { return {setup_.on_device, buffers_, seeds(), tree_}; }

  /// The ranks whose cells must be clipped region by region: whether they lie inside the domain could not be
  /// told.
  std::vector<std::uint32_t> by_region;

  /// Gives the seeds of exactly flat cells, by rank, a weight so low that they have no cell anywhere. Their
  /// walls lie between the cells on both sides of them.
  void exclude_flat_cells(std::span<const std::uint32_t> ranks);

  PackedTree release_tree() && { return std::move(tree_); }

 private:
  void set_hidden_aside();

  const Setup& setup_;
  const Input& input_;
  SeedBuffers& buffers_;
  std::optional<SeedSet> own_;  // where it is not the input's: seeds set aside, or weights changed
  PackedTree tree_;
};

}  // namespace powercell
