// STL in text, since only that has several solids and their names.
#include <array>
#include <cmath>

#include "apps/io/atomic_file.hpp"
#include "apps/io/write/formats.hpp"
#include "apps/io/write/wall_triangles.hpp"

namespace powercell::io {
namespace {

void write_numbers(AtomicFile& file, std::string_view start, const double* at) {
  file.write(start);
  for (std::size_t k = 0; k < 3; ++k) {
    file.write(' ');
    file.number(at[k] + 0.0);  // not -0
  }
  file.write('\n');
}

void write_triangle(AtomicFile& file, const std::array<const double*, 3>& corner) {
  std::array<double, 3> normal{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    normal[axis] = (corner[1][u] - corner[0][u]) * (corner[2][v] - corner[0][v]) -
                   (corner[1][v] - corner[0][v]) * (corner[2][u] - corner[0][u]);
  }
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  for (double& x : normal) x = length > 0 ? x / length : 0.0;
  write_numbers(file, "facet normal", normal.data());
  file.write("outer loop\n");
  for (const double* at : corner) write_numbers(file, "vertex", at);
  file.write("endloop\nendfacet\n");
}

}  // namespace

void write_stl(const std::string& path, const DiagramOutput& output) {
  const SharedCells cells = fitting_cells(path, output);
  AtomicFile file(path);
  for (std::size_t i = 0; i < cells.cell_count(); ++i) {
    if (cells.face_offset[i] == cells.face_offset[i + 1]) continue;
    const std::string name = "cell_" + std::to_string(i) + "\n";
    file.write("solid " + name);
    for (std::uint64_t f = cells.face_offset[i]; f < cells.face_offset[i + 1]; ++f) {
      const std::vector<std::uint32_t> triangles = triangles_of(path, cells, f);
      for (std::size_t t = 0; t < triangles.size(); t += 3)
        write_triangle(
            file, {cells.point(triangles[t]), cells.point(triangles[t + 1]), cells.point(triangles[t + 2])});
    }
    file.write("endsolid " + name);
  }
  file.commit();
}

}  // namespace powercell::io
