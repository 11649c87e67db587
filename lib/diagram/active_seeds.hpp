/// \file
/// The seeds that may have cells, on the host and on the device.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lib/diagram/given_seeds.hpp"
#include "lib/diagram/setup.hpp"
#include "lib/periodic/images.hpp"
#include "lib/scene/scene.hpp"

namespace powercell {

/// A packed tree with the images that it contains in a periodic domain.
struct KeptTree {
  PackedTree tree;
  std::optional<Images> images;
};

/// The active seeds in Hilbert order, their tree, and both on the device. Not movable, because scenes and
/// plans refer to it.
class ActiveSeeds {
 public:
  /// Builds the tree, uploads the seeds, and sets seeds aside that are proved hidden, if they are many.
  /// \param buffers  receive the seeds; must outlive this
  /// \param kept     released by earlier active seeds at the same positions; used where a new tree would be
  /// the
  ///                 same but for weights
  ActiveSeeds(const DiagramSetup& setup, const GivenSeeds& input, SeedBuffers& buffers,
              std::optional<KeptTree> kept);
  ActiveSeeds(const ActiveSeeds&) = delete;
  ActiveSeeds& operator=(const ActiveSeeds&) = delete;

  /// In a periodic domain those of images().
  const SeedSet& seeds() const { return images_ ? images_->seeds : own_ ? *own_ : input_.seeds; }
  /// Null unless the domain is periodic.
  const Images* images() const { return images_ ? &*images_ : nullptr; }
  /// From wrapped seeds to those given.
  /// \pre images()
  Placement placement() const { return {*setup_.period(), *images_, input_.unwrapped->shift}; }
  const PackedTree& tree() const { return tree_; }
  Scene scene() const { return scene_on(setup_.on_device, buffers_); }
  /// The same on another device.
  Scene scene_on(const DomainBuffers& domain, const SeedBuffers& buffers) const {
    return {domain, buffers, seeds(), tree_, images_.has_value()};
  }
  /// Another number whenever the seeds or the tree have changed.
  std::uint64_t uploads() const { return buffers_.uploads; }

  /// Ranks whose cells must be clipped region by region, because it is unclear whether they lie inside the
  /// domain.
  std::vector<std::uint32_t> by_region;

  /// Lowers the weights of seeds with exactly flat cells, by rank, until they have no cell anywhere. The
  /// cells on both sides of a flat cell then share its walls.
  void exclude_flat_cells(std::span<const std::uint32_t> ranks);

  /// Appends images within a wider margin; ranks stay, and candidates must be made anew.
  /// \pre images()
  /// \param clearance  as for powercell::widen
  /// \return whether there are any
  bool widen(double margin, std::span<const double> clearance);

  KeptTree release_tree() && { return {std::move(tree_), std::move(images_)}; }

 private:
  void build();
  void set_hidden_aside();

  const DiagramSetup& setup_;
  const GivenSeeds& input_;
  SeedBuffers& buffers_;
  std::optional<Images> images_;
  std::optional<SeedSet> own_;  // if not all seeds of the input with their weights
  PackedTree tree_;
};

}  // namespace powercell
