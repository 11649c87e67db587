#include "lib/applications/density/piece.hpp"

#include <array>
#include <span>

namespace powercell {
namespace {

/// The corners of a facet of a region, counter-clockwise seen from outside.
using Loop = std::array<std::uint32_t, 4>;
constexpr std::array<Loop, 4> tetrahedron_loops{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
constexpr std::array<Loop, 6> box_loops{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

void add_loops(Cells& cells, std::span<const Loop> loops, std::size_t corners) {
  for (const Loop& loop : loops) {
    cells.loop.insert(cells.loop.end(), loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(corners));
    cells.loop_offset.push_back(cells.loop.size());
  }
}

}  // namespace

Cells region_cells(const RegionsView& mesh) {
  Cells cells;
  cells.dimension = mesh.dimension;
  cells.cell_dimension = mesh.cell_dimension;
  cells.cell_offset = {0};
  cells.vertex_offset = {0};
  cells.face_offset = {0};
  cells.border.assign(mesh.facet.begin(), mesh.facet.end());
  if (cells.cell_dimension == 3) cells.loop_offset = {0};
  const auto d = static_cast<std::size_t>(mesh.dimension);
  for (std::uint32_t r = 0; r < mesh.size(); ++r) {
    for (std::uint32_t v = mesh.region_offset[r]; v < mesh.region_offset[r + 1]; ++v) {
      const double* x = &mesh.vertices[mesh.region_vertex[v] * d];
      cells.vertices.insert(cells.vertices.end(), x, x + d);
    }
    if (mesh.shape == RegionShape::tetrahedron) add_loops(cells, tetrahedron_loops, 3);
    if (mesh.shape == RegionShape::box) add_loops(cells, box_loops, 4);
    cells.region.push_back(r);
    cells.cell_offset.push_back(r + 1);
    cells.vertex_offset.push_back(cells.vertices.size() / d);
    cells.face_offset.push_back(mesh.facet_offset[r + 1]);
  }
  return cells;
}

}  // namespace powercell
