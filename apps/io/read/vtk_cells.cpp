#include "apps/io/read/vtk_cells.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/io/read/file.hpp"

namespace powercell::io {
namespace {

// VTK's numbers of kinds of cells (vtkCellType.h).
constexpr std::int64_t vtk_triangle = 5, vtk_strip = 6, vtk_polygon = 7, vtk_pixel = 8, vtk_quad = 9,
                       vtk_tetra = 10, vtk_quadratic_triangle = 22, vtk_quadratic_quad = 23,
                       vtk_quadratic_tetrahedron = 24;
// Nothing, points and lines.
constexpr std::int64_t vtk_skipped[] = {0, 1, 2, 3, 4, 21};

struct Solid {
  std::int64_t type;
  const char* name;
};
constexpr Solid other_solids[] = {{11, "voxel"},
                                  {12, "hexahedron"},
                                  {13, "wedge"},
                                  {14, "pyramid"},
                                  {15, "prism"},
                                  {16, "prism"},
                                  {vtk_quadratic_tetrahedron, "quadratic tetrahedron"},
                                  {42, "polyhedron"}};

void expect_corners(std::size_t cell, std::size_t got, std::size_t due, const char* kind,
                    const std::string& name) {
  if (got != due) fail_file(name, fmt::format("cell {} (from 0) is a {} with {} corners", cell, kind, got));
}

void add_face(const std::uint32_t* corners, std::initializer_list<int> order, MeshFile& mesh) {
  for (int k : order) mesh.face_vertex.push_back(corners[k]);
  mesh.end_face();
}

void add_cell(std::size_t cell, std::int64_t type, const std::vector<std::uint32_t>& corners,
              const std::string& name, MeshFile& mesh) {
  const std::size_t n = corners.size();
  if (std::ranges::find(vtk_skipped, type) != std::end(vtk_skipped)) return;
  switch (type) {
    case vtk_tetra:
      expect_corners(cell, n, 4, "tetrahedron", name);
      mesh.tetrahedra.insert(mesh.tetrahedra.end(), corners.begin(), corners.end());
      return;
    case vtk_triangle:
      expect_corners(cell, n, 3, "triangle", name);
      return add_face(corners.data(), {0, 1, 2}, mesh);
    case vtk_quad:
      expect_corners(cell, n, 4, "quadrilateral", name);
      return add_face(corners.data(), {0, 1, 2, 3}, mesh);
    case vtk_pixel:
      expect_corners(cell, n, 4, "pixel", name);
      return add_face(corners.data(), {0, 1, 3, 2}, mesh);
    case vtk_polygon:
      mesh.face_vertex.insert(mesh.face_vertex.end(), corners.begin(), corners.end());
      return mesh.end_face();
    case vtk_strip:  // every second triangle has the opposite orientation
      for (std::size_t k = 2; k < n; ++k)
        k % 2 == 0 ? add_face(corners.data() + k - 2, {0, 1, 2}, mesh)
                   : add_face(corners.data() + k - 2, {1, 0, 2}, mesh);
      return;
    case vtk_quadratic_triangle:
    case vtk_quadratic_quad:
      fail_file(
          name,
          fmt::format("cell {} (from 0) is a curved face of second order; save a mesh of first order", cell));
    default:
      break;
  }
  const auto solid = std::ranges::find(other_solids, type, &Solid::type);
  if (solid == std::end(other_solids))
    fail_file(name, fmt::format("cell {} (from 0) is of VTK's type {}, which is not read", cell, type));
  if (!mesh.other_solid.empty()) return;
  mesh.other_solid = fmt::format("a {} (cell {}, from 0)", solid->name, cell);
  mesh.other_is_quadratic = type == vtk_quadratic_tetrahedron;
}

}  // namespace

void add_vtk_cells(const VtkCells& cells, std::size_t base, const std::string& name, MeshFile& mesh) {
  const auto vertices = static_cast<std::int64_t>(mesh.vertex_count() - base);
  std::vector<std::uint32_t> corners;
  for (std::size_t cell = 0; cell < cells.type.size(); ++cell) {
    const std::int64_t begin = cells.offset[cell], end = cells.offset[cell + 1];
    if (begin < 0 || begin > end || end > static_cast<std::int64_t>(cells.connectivity.size())) {
      fail_file(name, fmt::format("cell {} (from 0): corners {} to {} of {} are not a range", cell, begin,
                                  end, cells.connectivity.size()));
    }
    corners.clear();
    for (std::int64_t k = begin; k < end; ++k) {
      const std::int64_t index = cells.connectivity[static_cast<std::size_t>(k)];
      if (index < 0 || index >= vertices) {
        fail_file(
            name,
            fmt::format("cell {} (from 0): index {} is out of range; there are {} points, numbered from 0",
                        cell, index, vertices));
      }
      corners.push_back(static_cast<std::uint32_t>(base + static_cast<std::size_t>(index)));
    }
    add_cell(cell, cells.type[cell], corners, name, mesh);
  }
}

}  // namespace powercell::io
