// Pictures of surfaces: cells of a diagram, and triangles of a mesh.
#include <algorithm>
#include <cmath>

#include "apps/io/picture/colours.hpp"
#include "apps/io/picture/models.hpp"

namespace powercell::io {
namespace {

constexpr Colour clay{0xe8, 0xc9, 0xa0};

// Lines are thinner for smaller parts, and absent if they would hide the parts. \param width  pixels for one
// part
float line_width(double width, std::size_t parts, double least, double most) {
  width /= std::sqrt(static_cast<double>(std::max<std::size_t>(parts, 1)));
  return width < 0.25 ? 0.0f : static_cast<float>(std::clamp(width, least, most));
}

}  // namespace

Model surface_model(const DiagramOutput& output) {
  const Normalization normalize = normalization(output.domain);
  const RegionsView mesh = output.domain.regions();
  const std::vector<Vec3> normals = corner_normals(mesh, normalize);
  const std::vector<Colour> colours = colouring_of(output).colour;
  const Cells& cells = output.cells;
  Model model;
  model.line_width = line_width(80, output.measures.count(SeedStatus::ok), 0.6, 3.2);
  for (std::uint32_t i = 0; i < cells.cell_count(); ++i)
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p) {
      const TriangleNormals normal_at(mesh, normals, normalize, cells.region[p]);
      const std::uint64_t first = cells.vertex_offset[p];
      for (std::uint64_t v = first + 1; v + 1 < cells.vertex_offset[p + 1]; ++v) {
        Model::Triangle triangle{{}, {}, colours[i], i};
        const std::uint64_t at[3] = {first, v, v + 1};
        for (std::size_t k = 0; k < 3; ++k) {
          triangle.corner[k] = normalize(&cells.vertices[3 * at[k]]);
          triangle.normal[k] = normal_at(triangle.corner[k]);
        }
        model.triangles.push_back(triangle);
      }
    }
  return model;
}

Model mesh_model(const TriangleMesh& mesh, const Normalization& normalize) {
  const Domain domain = Domain::surface(mesh.vertices, mesh.triangles);
  const RegionsView regions = domain.regions();
  const std::vector<Vec3> normals = corner_normals(regions, normalize);
  Model model;
  model.line_width = line_width(70, regions.size(), 0.5, 2.5);
  for (std::uint32_t r = 0; r < regions.size(); ++r) {
    Model::Triangle triangle{{}, {}, clay, r};
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.corner[k] =
          normalize(&regions.vertices[3 * std::size_t{regions.region_vertex[3 * std::size_t{r} + k]}]);
      triangle.normal[k] = normals[3 * std::size_t{r} + k];
    }
    model.triangles.push_back(triangle);
  }
  return model;
}

}  // namespace powercell::io
