/// \file
/// Candidates from the packed tree of the seeds, searched in the kernel, and from lists that spare the
/// search. Internal.
#pragma once

#include "lib/neighbors/candidates.hpp"
#include "lib/neighbors/cell_bounds.hpp"
#include "lib/neighbors/tree_blocks.hpp"
#include "lib/scene/variant.hpp"

namespace powercell {

/// The tree of the scene as it is on the device.
TreeBlocks::Tree device_tree(const Scene& scene);
/// The precision and dimensions of the scene, for programs without cells.
Variant without_cells(const Scene& scene);

/// Each pair searches the tree (kernels/clip/by_tree.cl).
class TreeCandidates : public Candidates {
 public:
  /// Makes the blocks of the tree; enqueues without waiting. \param searched  whether any pair will be
  /// searched for in the tree
  explicit TreeCandidates(const Scene& scene, bool searched = true);
  std::string_view file() const override { return "clip/by_tree.cl"; }
  std::string_view kernel() const override { return "clip_by_tree_kernel"; }
  void set_arguments(cl::Kernel& kernel, unsigned first) const override;
  std::unique_ptr<Candidates> for_scene(const Scene& scene) const override;

 protected:
  const Scene scene_;

 private:
  TreeBlocks blocks_;
};

/// Pairs with a region that has a list of seeds try these, the others search the tree
/// (kernels/clip/by_region.cl).
class RegionCandidates : public TreeCandidates {
 public:
  /// Uploads the lists (Pairs::list_offset, list_seed); regions behind the last list have none.
  /// \param all_listed  whether every region with a pair has a list
  RegionCandidates(const Scene& scene, std::span<const std::uint64_t> list_offset,
                   std::span<const std::uint32_t> list_seed, bool all_listed);
  std::string_view file() const override { return "clip/by_region.cl"; }
  std::string_view kernel() const override { return "clip_by_region_kernel"; }
  void set_arguments(cl::Kernel& kernel, unsigned first) const override;
  std::unique_ptr<Candidates> for_scene(const Scene& scene) const override;

 private:
  cl::Buffer<std::uint64_t> list_offset_;  ///< regions + 1
  cl::Buffer<std::uint32_t> list_seed_;
};

/// Pairs with a cell whose neighbours are known try these, and the planes of the boundary where the cell has
/// any; the others search the tree (kernels/clip/by_cell.cl). Pays where a cell meets several regions, in
/// domains of full dimension: there the piece of seed i in a region is the region cut by the bisectors of i
/// that bound its unrestricted cell, and by no others.
class CellCandidates : public TreeCandidates {
 public:
  /// Uploads walls and planes. \pre planes are for double precision and fewer than BORDER_PLANE seeds
  CellCandidates(TreeCandidates tree, const CellWalls& walls, const CellPlanes& planes);
  std::string_view file() const override { return "clip/by_cell.cl"; }
  std::string_view kernel() const override { return "clip_by_cell_kernel"; }
  void set_arguments(cl::Kernel& kernel, unsigned first) const override;
  std::unique_ptr<Candidates> for_scene(const Scene& scene) const override;

 private:
  cl::Buffer<std::uint32_t> wall_offset_, neighbor_, plane_offset_;
  cl::RawBuffer plane_;
};

}  // namespace powercell
