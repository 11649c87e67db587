/// \file
/// One piece clipped on the host, with exact decisions: for pieces that rounding may have decided on the
/// device, or that fit none of its variants.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "lib/base/vectors.hpp"
#include "lib/cell/pieces.hpp"
#include "lib/scene/scene.hpp"

namespace powercell {

/// A node of the packed tree.
struct HostNode {
  Vector3<double> low, high;
  double weight;  ///< the largest in it
};

/// Domain, seeds and tree in double precision, scaled as for devices.
struct HostScene {
  const RegionMesh* mesh = nullptr;
  const PackedTree* tree = nullptr;
  std::vector<std::array<double, 4>> corners, points;  ///< x y z weight
  std::vector<HostNode> nodes;                         ///< numbered as in the tree
  std::vector<std::int32_t> behind;                    ///< of the facets (regions_behind)
  region_shape_t shape{};
  bool ties_by_position = false;  ///< Scene::ties_by_position

  /// Whether seed `a`, by rank, comes before seed `b` in the order that breaks ties.
  bool breaks_ties_before(std::int32_t a, std::int32_t b) const {
    if (!ties_by_position) return a < b;
    const auto &p = points[static_cast<std::size_t>(a)], &q = points[static_cast<std::size_t>(b)];
    return std::lexicographical_compare(p.begin(), p.begin() + 3, q.begin(), q.begin() + 3);
  }
  const HostNode& node(std::uint32_t at, std::int32_t level) const {
    return nodes[tree->level_offset[static_cast<std::size_t>(level)] + at];
  }
};

/// The scene must outlive the result.
HostScene make_host_scene(const Scene& scene);

/// Clips one piece after the other; each thread needs its own.
class HostClipper {
 public:
  virtual ~HostClipper() = default;
  /// Clips the piece of seed `rank` in `region` by all other seeds: returns its status (PIECE_DONE, _EMPTY
  /// or _FLAT), writes its 2 + dimension moments and appends its row.
  /// \throw Error internal if the result contradicts itself: a defect (names the seed by its rank)
  virtual int clip(std::uint32_t rank, std::uint32_t region, std::span<double> moments, PieceBatch& rows) = 0;
  /// At least the distance of the farthest vertex of the last piece from its seed, if it is not empty.
  virtual double radius() const = 0;
  /// Whether infinitesimals (86) decided anything about the last piece.
  virtual bool met_tie() const = 0;

  /// \param scene     must outlive the clipper
  /// \param geometry  whether rows have vertices
  /// \param perturbed  as ClipOptions::perturbed
  static std::unique_ptr<HostClipper> make(const HostScene& scene, bool geometry, bool perturbed = false);
};

}  // namespace powercell
