#include "lib/domain/outline.hpp"

namespace powercell {
namespace {

void add_corner(RegionMesh& mesh, const std::array<double, 3>& x) {
  mesh.region_vertex.push_back(
      static_cast<std::uint32_t>(mesh.vertices.size() / static_cast<std::size_t>(mesh.dimension)));
  mesh.vertices.insert(mesh.vertices.end(), x.begin(), x.begin() + mesh.dimension);
}

}  // namespace

bool has_inside(const RegionMesh& mesh) {
  return mesh.dimension == mesh.cell_dimension && mesh.region_count() > 1 && mesh.shape != RegionShape::box;
}

RegionMesh boundary_of(const RegionMesh& mesh) {
  RegionMesh boundary;
  boundary.kind = mesh.kind;
  boundary.dimension = mesh.dimension;
  boundary.cell_dimension = mesh.dimension - 1;
  boundary.vertices = mesh.vertices;
  boundary.low = mesh.low;
  boundary.high = mesh.high;
  boundary.region_offset.push_back(0);
  if (!has_inside(mesh)) return boundary;
  for (std::uint32_t region = 0; region < mesh.region_count(); ++region) {
    const std::uint32_t first = mesh.facet_offset[region], last = mesh.facet_offset[region + 1];
    const std::uint32_t* corner = &mesh.region_vertex[mesh.region_offset[region]];
    for (std::uint32_t f = first; f < last; ++f) {
      if (mesh.facet[f].kind != Border::Kind::boundary) continue;
      const std::uint32_t k = f - first;
      if (mesh.dimension == 3) {
        for (const std::uint32_t c : tetrahedron_facet[k]) boundary.region_vertex.push_back(corner[c]);
      } else {
        boundary.region_vertex.push_back(corner[k]);
        boundary.region_vertex.push_back(corner[k + 1 == last - first ? 0 : k + 1]);
      }
      boundary.region_offset.push_back(static_cast<std::uint32_t>(boundary.region_vertex.size()));
      boundary.source.push_back(f);
    }
  }
  return boundary;
}

RegionMesh with_container(const RegionMesh& mesh) {
  RegionMesh all = mesh;
  std::array<double, 3> low{}, size{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(mesh.dimension); ++k) {
    const double margin = (mesh.high[k] - mesh.low[k]) / 16;
    low[k] = mesh.low[k] - margin;
    size[k] = mesh.high[k] + margin - low[k];
  }
  if (mesh.dimension == 2) {
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      add_corner(all, {low[0] + x * size[0], low[1] + y * size[1], 0});
  } else {
    // The tetrahedron of the half-spaces x, y, z >= low and one whose plane passes through the far corner.
    add_corner(all, low);
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<double, 3> x = low;
      x[k] += 3 * size[k];
      add_corner(all, x);
    }
  }
  all.region_offset.push_back(static_cast<std::uint32_t>(all.region_vertex.size()));
  for (int f = 0; f < 4; ++f) all.facet.push_back({Border::Kind::boundary, all.boundary_count++});
  all.facet_offset.push_back(static_cast<std::uint32_t>(all.facet.size()));
  all.source.push_back(0);
  return all;
}

}  // namespace powercell
