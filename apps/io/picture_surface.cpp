// Pictures of surfaces: cells of a diagram, and triangles of a mesh.
#include <algorithm>
#include <cmath>

#include "apps/io/picture_colours.hpp"
#include "apps/io/picture_models.hpp"

namespace powercell::io {
namespace {

constexpr Colour clay{0xe8, 0xc9, 0xa0};

// Shares of a triangle's corners at a point in its plane.
std::array<float, 3> barycentric(Vec3 p, const std::array<Vec3, 3>& corner) {
  const Vec3 n = cross(corner[1] - corner[0], corner[2] - corner[0]);
  const float squared = dot(n, n);
  if (!(squared > 0)) return {1, 0, 0};
  const float u = dot(cross(corner[2] - corner[1], p - corner[1]), n) / squared;
  const float v = dot(cross(corner[0] - corner[2], p - corner[2]), n) / squared;
  return {u, v, 1 - u - v};
}

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
      const std::size_t first_corner = 3 * std::size_t{cells.region[p]};
      std::array<Vec3, 3> corner;
      for (std::size_t k = 0; k < 3; ++k)
        corner[k] = normalize(&mesh.vertices[3 * std::size_t{mesh.region_vertex[first_corner + k]}]);
      const std::uint64_t first = cells.vertex_offset[p];
      for (std::uint64_t v = first + 1; v + 1 < cells.vertex_offset[p + 1]; ++v) {
        Model::Triangle triangle{{}, {}, colours[i], i};
        const std::uint64_t at[3] = {first, v, v + 1};
        for (std::size_t k = 0; k < 3; ++k) {
          triangle.corner[k] = normalize(&cells.vertices[3 * at[k]]);
          const auto share = barycentric(triangle.corner[k], corner);
          triangle.normal[k] =
              normalized(normals[first_corner] * share[0] + normals[first_corner + 1] * share[1] +
                         normals[first_corner + 2] * share[2]);
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
