#include "apps/io/read_vtk_cells.hpp"

#include <fmt/format.h>

#include "apps/io/read_file.hpp"

namespace powercell::io {
namespace {

// VTK's numbers of kinds of cells (vtkCellType.h).
enum : std::int64_t {
  kEmpty = 0,
  kVertex = 1,
  kPolyVertex = 2,
  kLine = 3,
  kPolyLine = 4,
  kTriangle = 5,
  kStrip = 6,
  kPolygon = 7,
  kPixel = 8,
  kQuad = 9,
  kTetra = 10,
  kVoxel = 11,
  kHexahedron = 12,
  kWedge = 13,
  kPyramid = 14,
  kPentagonalPrism = 15,
  kHexagonalPrism = 16,
  kQuadraticEdge = 21,
  kQuadraticTriangle = 22,
  kQuadraticQuad = 23,
  kQuadraticTetra = 24,
  kPolyhedron = 42
};

const char* solid_name(std::int64_t type) {
  switch (type) {
    case kVoxel:
      return "voxel";
    case kHexahedron:
      return "hexahedron";
    case kWedge:
      return "wedge";
    case kPyramid:
      return "pyramid";
    case kPentagonalPrism:
    case kHexagonalPrism:
      return "prism";
    case kQuadraticTetra:
      return "quadratic tetrahedron";
    case kPolyhedron:
      return "polyhedron";
    default:
      return nullptr;
  }
}

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
  switch (type) {
    case kEmpty:
    case kVertex:
    case kPolyVertex:
    case kLine:
    case kPolyLine:
    case kQuadraticEdge:
      return;
    case kTetra:
      expect_corners(cell, n, 4, "tetrahedron", name);
      mesh.tetrahedra.insert(mesh.tetrahedra.end(), corners.begin(), corners.end());
      return;
    case kTriangle:
      expect_corners(cell, n, 3, "triangle", name);
      return add_face(corners.data(), {0, 1, 2}, mesh);
    case kQuad:
      expect_corners(cell, n, 4, "quadrilateral", name);
      return add_face(corners.data(), {0, 1, 2, 3}, mesh);
    case kPixel:
      expect_corners(cell, n, 4, "pixel", name);
      return add_face(corners.data(), {0, 1, 3, 2}, mesh);
    case kPolygon:
      mesh.face_vertex.insert(mesh.face_vertex.end(), corners.begin(), corners.end());
      return mesh.end_face();
    case kStrip:  // every second triangle runs the other way round
      for (std::size_t k = 2; k < n; ++k) {
        k % 2 == 0 ? add_face(corners.data() + k - 2, {0, 1, 2}, mesh)
                   : add_face(corners.data() + k - 2, {1, 0, 2}, mesh);
      }
      return;
    case kQuadraticTriangle:
    case kQuadraticQuad:
      fail_file(
          name,
          fmt::format("cell {} (from 0) is a curved face of second order; save a mesh of first order", cell));
    default:
      break;
  }
  const char* solid = solid_name(type);
  if (solid == nullptr)
    fail_file(name, fmt::format("cell {} (from 0) is of VTK's type {}, which is not read", cell, type));
  if (mesh.other_solid.empty()) mesh.other_solid = fmt::format("a {} (cell {}, from 0)", solid, cell);
}

}  // namespace

void add_vtk_cells(const VtkCells& cells, std::size_t base, const std::string& name, MeshFile& mesh) {
  const auto vertices = static_cast<std::int64_t>(mesh.vertex_count() - base);
  std::vector<std::uint32_t> corners;
  for (std::size_t cell = 0; cell < cells.type.size(); ++cell) {
    const std::int64_t begin = cells.offset[cell], end = cells.offset[cell + 1];
    if (begin < 0 || begin > end || end > static_cast<std::int64_t>(cells.connectivity.size())) {
      fail_file(name, fmt::format("cell {} (from 0): corners {} to {} of {} are no range", cell, begin, end,
                                  cells.connectivity.size()));
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
