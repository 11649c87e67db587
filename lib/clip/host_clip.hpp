/// \file
/// One piece clipped on the host, with exact decisions and arrays that grow, by the kernels' own source compiled
/// as C++: for pieces that rounding may have decided on the device, or that fit none of its variants.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lib/clip/exact_cell.hpp"
#include "lib/clip/pieces.hpp"
#include "lib/clip/scene.hpp"

namespace powercell {

/// Result of one piece; `batch` has a single row.
struct HostPiece {
  int status;
  std::vector<double> moments;  ///< 2 + dimension
  PieceBatch batch;
};

/// Points packed as kernels see them, in double.
struct HostScene {
  std::vector<std::byte> corners, points, node_low, node_high;
  std::vector<std::int32_t> behind;
  region_shape_t shape;
  const RegionMesh* mesh;
  const PackedTree* tree;
  std::vector<double> seed_block, node_block;  ///< kernels/neighbors/blocks.cl
  std::vector<std::uint32_t> near_count;       ///< per leaf: none, since lists serve many cells
  std::vector<double> near_bound;
  ExactScale scale;
};

HostScene make_host_scene(const Scene& scene);

/// Clips the piece of seed `rank` in `region` by all other seeds.
/// \throw Error internal if the result contradicts itself: a defect (names the seed by its rank)
HostPiece clip_on_host(const HostScene& scene, std::uint32_t rank, std::uint32_t region);

}  // namespace powercell
