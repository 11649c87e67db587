/// \file
/// Functions given by values at the vertices of a mesh, affine in each triangle or tetrahedron.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <powercell/error.hpp>
#include <powercell/regions.hpp>
#include <span>

#include "lib/base/vectors.hpp"

namespace powercell {

/// \throw Error unsupported unless the regions of the domain are triangles or tetrahedra with the vertices
///   that its maker gave
inline void require_simplices(const Domain& domain) {
  if (domain.kind() == DomainKind::polygon || domain.regions().shape == RegionShape::box)
    throw Error(ErrorCode::unsupported,
                "a density given at vertices needs a mesh of triangles or tetrahedra as domain");
}

/// x -> value + gradient . (x - origin)
struct AffineFunction {
  Vector3<double> origin{}, gradient{};
  double value = 0;

  double operator()(const Vector3<double>& x) const {
    const Vector3<double> y = x - origin;
    return value + gradient[0] * y[0] + gradient[1] * y[1] + gradient[2] * y[2];
  }
};

/// The function in a region, by the values at its corners. In a triangle it is constant along the normal.
/// \param values  one per vertex of the mesh
/// \pre require_simplices() has accepted the domain
inline AffineFunction affine_in_region(const RegionsView& mesh, std::uint32_t region,
                                       std::span<const double> values) {
  const std::uint32_t* corner = &mesh.region_vertex[mesh.region_offset[region]];
  const auto vertex = [&](std::uint32_t v) {
    return Vector3<double>{mesh.vertices[3 * v], mesh.vertices[3 * v + 1], mesh.vertices[3 * v + 2]};
  };
  AffineFunction f;
  f.origin = vertex(corner[0]);
  f.value = values[corner[0]];
  Vector3<double> a = vertex(corner[1]) - f.origin, b = vertex(corner[2]) - f.origin, c{};
  const double da = values[corner[1]] - f.value, db = values[corner[2]] - f.value;
  double dc = 0;
  if (mesh.cell_dimension == 3) {
    c = vertex(corner[3]) - f.origin;
    dc = values[corner[3]] - f.value;
  }
  // In units of the region's size: products of four lengths may overflow.
  double size = 0;
  for (const Vector3<double>* edge : {&a, &b, &c})
    for (const double x : *edge) size = std::max(size, std::abs(x));
  for (Vector3<double>* edge : {&a, &b, &c})
    for (double& x : *edge) x /= size;
  if (mesh.cell_dimension == 2) c = cross(a, b);
  const Vector3<double> bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const double determinant = dot(a, bc);
  for (std::size_t k = 0; k < 3; ++k)
    f.gradient[k] = (da * bc[k] + db * ca[k] + dc * ab[k]) / determinant / size;
  return f;
}

}  // namespace powercell
