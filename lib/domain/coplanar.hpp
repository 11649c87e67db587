/// \file
/// Triangles of a surface that lie in one plane.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "lib/domain/measure.hpp"

namespace powercell {

/// Whether the corners of b lie in the plane of a, up to `depth`.
bool in_plane_of(const std::array<Vector3<double>, 3>& a, const std::array<Vector3<double>, 3>& b,
                 double depth);

/// Per edge of a triangle with corners a: whether exactly one other continues it in its plane there.
std::array<bool, 3> continued(const RegionMesh& mesh, std::uint32_t region,
                              const std::array<Vector3<double>, 3>& a, double depth);

/// Calls `group` with the triangles of each plane that has several. Planes that differ by the rounding of
/// coordinates count as one; a group may also have triangles of other planes, and two groups may be of one.
/// \param depth  that rounding
/// \return the triangles whose planes are too uncertain to tell, as rounding could turn them
std::vector<std::uint32_t> for_each_plane(const RegionMesh& mesh, double depth,
                                          const std::function<void(std::span<const std::uint32_t>)>& group);

}  // namespace powercell
