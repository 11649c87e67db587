/// \file
/// One piece clipped on the host, with exact decisions and arrays that grow, by the kernels' own source
/// compiled as C++: for pieces that rounding may have decided on the device, or that fit none of its
/// variants.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lib/clip/exact_cell.hpp"
#include "lib/clip/pieces.hpp"
#include "lib/scene/scene.hpp"

namespace powercell {

/// Points packed as kernels see them, in double.
struct HostScene {
  std::vector<std::byte> corners, points, node_low, node_high;
  std::vector<std::int32_t> behind;
  region_shape_t shape;
  const RegionMesh* mesh;
  const PackedTree* tree;
  std::vector<double> seed_block, node_block;  ///< kernels/neighbors/blocks.cl
  std::unique_ptr<std::uint32_t[]>
      near;  ///< of the leaves that list_near has seen (kernels/neighbors/near.cl)
  std::vector<std::uint32_t> near_count;  ///< per leaf: 0 for the others
  std::vector<double> near_bound;
};

HostScene make_host_scene(const Scene& scene);

/// Lists what is near the leaves of the seeds `ranks`, ascending: quicker where many cells are clipped, else
/// not needed.
void list_near(HostScene& scene, std::span<const std::uint32_t> ranks, int threads);

/// Clips one piece after the other; each thread needs its own.
class HostClipper {
 public:
  virtual ~HostClipper() = default;
  /// Clips the piece of seed `rank` in `region` by all other seeds: returns its status (PIECE_WHOLE, _EMPTY
  /// or _FLAT), writes its 2 + dimension moments and appends its row. \throw Error internal if the result
  /// contradicts itself: a defect (names the seed by its rank)
  virtual int clip(std::uint32_t rank, std::uint32_t region, std::span<double> moments, PieceBatch& rows) = 0;

  /// \param scene     must outlive the clipper
  /// \param geometry  whether rows have vertices
  static std::unique_ptr<HostClipper> make(const HostScene& scene, bool geometry);
};

}  // namespace powercell
