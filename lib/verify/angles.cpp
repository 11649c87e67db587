#include "lib/verify/angles.hpp"

#include <cmath>

namespace powercell {

Corners corners_of(const RegionMesh& mesh, std::size_t r) {
  const auto d = static_cast<std::size_t>(mesh.dimension);
  Corners corners;
  for (std::uint32_t k = mesh.region_offset[r]; k < mesh.region_offset[r + 1]; ++k) {
    const double* x = &mesh.vertices[mesh.region_vertex[k] * d];
    corners.push_back({x[0], x[1], d == 3 ? x[2] : 0.0});
  }
  return corners;
}

std::vector<Corners> facets_of(const RegionMesh& mesh, const Corners& corner) {
  static constexpr int box[6][4] = {{0, 2, 4, 6}, {1, 3, 5, 7}, {0, 1, 4, 5},
                                    {2, 3, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}};
  std::vector<Corners> facets;
  if (mesh.cell_dimension == 2) {
    for (std::size_t k = 0; k < corner.size(); ++k)
      facets.push_back({corner[k], corner[(k + 1) % corner.size()]});
  } else if (mesh.shape == RegionShape::tetrahedron) {
    for (const auto& [a, b, c] : tetrahedron_facet) facets.push_back({corner[a], corner[b], corner[c]});
  } else {
    for (const auto& [a, b, c, d] : box) facets.push_back({corner[a], corner[b], corner[c], corner[d]});
  }
  return facets;
}

Vector normal_of(const Corners& corner) {
  return cross(corner[1] - corner[0], corner[2] - corner[0]);
}

long double sine_between(const Vector& a, const Vector& b) {
  return norm(cross(a, b)) / (norm(a) * norm(b));
}
long double sine_to_plane(const Vector& direction, const Vector& normal) {
  return std::fabs(dot(direction, normal)) / (norm(direction) * norm(normal));
}

}  // namespace powercell
