/// \file
/// Candidates from a search of the packed tree in the kernel, or from lists that replace the search.
#pragma once

#include <span>

#include "lib/neighbors/candidates.hpp"
#include "lib/neighbors/cell_bounds.hpp"
#include "lib/neighbors/tree_blocks.hpp"
#include "lib/scene/variant.hpp"

namespace powercell {

/// The scene's tree on the device.
TreeBlocks::Tree device_tree(const Scene& scene);
/// A variant with the scene's precision and dimensions, for programs that hold no cell.
Variant without_cells(const Scene& scene);

/// Searches the tree for each pair (kernels/clip/by_tree.cl).
class TreeCandidates : public Candidates {
 public:
  /// Enqueues the construction of the tree's blocks, unless the scene has them, without waiting.
  /// \param searched  false if no pair will need the tree
  explicit TreeCandidates(const Scene& scene, bool searched = true);
  std::string_view file() const override { return "clip/by_tree.cl"; }
  std::string_view kernel() const override { return "clip_by_tree_kernel"; }
  void append_arguments(cl::Kernel& kernel) const override;
  std::unique_ptr<Candidates> for_scene(const Scene& scene) const override;
  std::unique_ptr<Candidates> on(const Scene& scene) const override;

 protected:
  const Scene& scene() const { return scene_; }

 private:
  const Scene scene_;
  TreeBlocks blocks_;
};

/// Takes candidates from the list of seeds of a pair's region, or searches the tree if it has none
/// (kernels/clip/by_region.cl).
class RegionCandidates : public TreeCandidates {
 public:
  /// Uploads the lists (Pairs::list_offset, list_seed). Regions after the last list have none.
  /// \param all_listed  whether every region with a pair has a list
  RegionCandidates(const Scene& scene, std::span<const std::uint64_t> list_offset,
                   std::span<const std::uint32_t> list_seed, bool all_listed);
  std::string_view file() const override { return "clip/by_region.cl"; }
  std::string_view kernel() const override { return "clip_by_region_kernel"; }
  void append_arguments(cl::Kernel& kernel) const override;
  std::unique_ptr<Candidates> for_scene(const Scene& scene) const override;
  std::unique_ptr<Candidates> on(const Scene& scene) const override;

 private:
  bool all_listed_;
  cl::Buffer<std::uint64_t> list_offset_;  ///< regions + 1
  cl::Buffer<std::uint32_t> list_seed_;
};

/// Takes the known neighbours of a pair's cell, or searches the tree if they are not known
/// (kernels/clip/by_cell.cl). Pays where a cell meets several regions. For domains of full dimension, where
/// no other bisector than those of its unrestricted cell cuts a piece.
class CellCandidates : public TreeCandidates {
 public:
  /// Uploads the neighbours: CellWalls::offset, neighbor.
  CellCandidates(TreeCandidates tree, std::span<const std::uint32_t> wall_offset,
                 std::span<const std::uint32_t> neighbor);
  std::string_view file() const override { return "clip/by_cell.cl"; }
  std::string_view kernel() const override { return "clip_by_cell_kernel"; }
  void append_arguments(cl::Kernel& kernel) const override;
  std::unique_ptr<Candidates> for_scene(const Scene& scene) const override;
  std::unique_ptr<Candidates> on(const Scene& scene) const override;

 private:
  cl::Buffer<std::uint32_t> wall_offset_, neighbor_;
};

}  // namespace powercell
