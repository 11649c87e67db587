/// \file
/// Candidates from the cells of the whole space: each cell is clipped once in a region around the domain, and
/// its pieces by its neighbours alone (kernels/clip/by_cell.cl).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "lib/neighbors/cell_planes.hpp"
#include "lib/neighbors/cell_walls.hpp"
#include "lib/neighbors/tree_candidates.hpp"

namespace powercell {

/// Pays where seeds meet several regions each, in domains of full dimension: there the piece of seed i in a
/// region is the region cut by the bisectors of i that bound its cell, and no others.
class CellCandidates : public TreeCandidates {
 public:
  /// Clips the cells of the given ranks, ascending, in the last region of the scene; those of others are
  /// searched for in each region. Waits for the device. \pre the last region holds all others \throw Error as
  /// Clipper
  CellCandidates(const Scene& scene, std::span<const std::uint32_t> ranks);
  std::string_view file() const override { return "clip/by_cell.cl"; }
  std::string_view kernel() const override { return "clip_by_cell_kernel"; }
  void set_arguments(cl::Kernel& kernel, unsigned first) override;
  std::unique_ptr<Candidates> for_scene(const Scene& scene) const override;

  const CellWalls& walls() const { return walls_; }

  /// The regions that the cell of a rank can meet.
  using Regions = std::function<std::vector<std::uint32_t>(std::uint32_t rank)>;
  /// From now on cuts the pieces that these cells have in the last region by their planes as well; where the
  /// host has to clip them it does so in `regions`. \pre double precision, less than BORDER_PLANE seeds
  void set_planes(const CellPlanes& planes, Regions regions);
  std::vector<std::uint32_t> regions_for_host(std::uint32_t rank, std::uint32_t region) const override;

 private:
  const Scene& scene_;
  CellWalls walls_;
  std::vector<std::uint32_t> cut_by_planes_;  // ranks, ascending
  Regions regions_;
  cl::Buffer<std::uint32_t> wall_offset_, neighbor_, plane_offset_;
  cl::RawBuffer plane_;
};

}  // namespace powercell
