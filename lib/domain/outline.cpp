#include "lib/domain/outline.hpp"

#include "lib/base/positions.hpp"
#include "lib/domain/adjacency.hpp"

namespace powercell {
namespace {

void add_corner(RegionMesh& mesh, const std::array<double, 3>& x) {
  mesh.region_vertex.push_back(
      static_cast<std::uint32_t>(mesh.vertices.size() / static_cast<std::size_t>(mesh.dimension)));
  mesh.vertices.insert(mesh.vertices.end(), x.begin(), x.begin() + mesh.dimension);
}

}  // namespace

bool has_inside(const RegionMesh& mesh) {
  if (mesh.solid_boundary) return true;
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

RegionMesh boundary_surface(const RegionMesh& mesh) {
  if (mesh.solid_boundary) return *mesh.solid_boundary;
  RegionMesh surface = boundary_of(mesh);
  surface.kind = DomainKind::surface;
  surface.vertices.clear();
  constexpr std::uint32_t unused = ~std::uint32_t{0};
  std::vector<std::uint32_t> number(mesh.vertices.size() / 3, unused);
  for (std::uint32_t& v : surface.region_vertex) {
    if (number[v] == unused) {
      number[v] = static_cast<std::uint32_t>(surface.vertices.size() / 3);
      surface.vertices.insert(surface.vertices.end(), &mesh.vertices[3 * std::size_t{v}],
                              &mesh.vertices[3 * std::size_t{v}] + 3);
    }
    v = number[v];
  }
  surface.facet_offset = surface.region_offset;
  surface.facet.assign(surface.region_vertex.size(), {Border::Kind::boundary, 0});
  return surface;
}

std::vector<std::uint32_t> edge_numbers(const RegionMesh& triangles) {
  const std::vector<std::uint32_t> same = first_at_position(triangles.vertices, 3);
  std::vector<FacetKey<2>> edges(triangles.region_vertex.size());
  for (std::uint32_t slot = 0; slot < edges.size(); ++slot) {
    const std::uint32_t next = slot % 3 == 2 ? slot - 2 : slot + 1;
    const auto [a, b] = std::minmax(same[triangles.region_vertex[slot]], same[triangles.region_vertex[next]]);
    edges[slot] = {{a, b}, slot};
  }
  std::vector<std::uint32_t> number(edges.size());
  std::uint32_t count = 0;
  for_each_shared(edges, [&](std::span<const FacetKey<2>> shared) {
    for (const FacetKey<2>& edge : shared) number[edge.slot] = count;
    ++count;
  });
  return number;
}

RegionMesh boxes_around(const RegionMesh& mesh, std::span<const double> corners) {
  RegionMesh boxes;
  boxes.kind = DomainKind::volume;
  boxes.dimension = boxes.cell_dimension = 3;
  boxes.shape = RegionShape::box;
  boxes.low = mesh.low;
  boxes.high = mesh.high;
  boxes.region_offset = boxes.facet_offset = {0};
  for (std::size_t at = 0; at < corners.size(); at += 6) {
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      const auto coordinate = [&](std::uint32_t axis) {
        return corners[at + axis + 3 * (corner >> axis & 1)];
      };
      add_corner(boxes, {coordinate(0), coordinate(1), coordinate(2)});
    }
    boxes.region_offset.push_back(static_cast<std::uint32_t>(boxes.region_vertex.size()));
    for (std::uint32_t f = 0; f < 6; ++f) boxes.facet.push_back({Border::Kind::boundary, f});
    boxes.facet_offset.push_back(static_cast<std::uint32_t>(boxes.facet.size()));
    boxes.source.push_back(static_cast<std::uint32_t>(at / 6));
  }
  return boxes;
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
