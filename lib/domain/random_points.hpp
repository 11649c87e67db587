/// \file
/// Random points of a domain.
#pragma once

#include <optional>
#include <vector>

#include "lib/base/box_tree.hpp"
#include "lib/domain/measure.hpp"

namespace powercell {

struct Sample {
  std::uint32_t region;
  Vector point;  ///< third coordinate 0 in 2D
};

/// Points with uniform density, the same for the same random seed on every machine.
std::vector<Sample> random_points(const RegionMesh& mesh, std::size_t count, std::uint64_t random_seed);

/// Counts the triangles between a point and infinity, exactly.
class SolidPoints {
 public:
  /// \param boundary  RegionMesh::solid_boundary; must outlive this
  explicit SolidPoints(const RegionMesh& boundary);

  /// Whether a point lies inside; none if it lies on the boundary, or the line through it along x meets an
  /// edge.
  std::optional<bool> contains(const double* point) const;

 private:
  const RegionMesh& mesh_;
  std::vector<Box> boxes_;
  BoxTree tree_;
};

/// As random_points(), for a solid.
/// \throw Error unsupported if it fills less than a millionth of its box
std::vector<Sample> random_points_in_solid(const RegionMesh& mesh, std::size_t count,
                                           std::uint64_t random_seed);

}  // namespace powercell
