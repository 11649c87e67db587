#include <algorithm>
#include <cmath>

#include "apps/io/picture_cairo.hpp"
#include "apps/io/picture_normals.hpp"
#include "apps/io/picture_solid.hpp"

namespace powercell::io {
namespace {

// Shares of a triangle's corners at a point in its plane.
std::array<float, 3> barycentric(Vec3 p, const std::array<Vec3, 3>& corner) {
  const Vec3 n = cross(corner[1] - corner[0], corner[2] - corner[0]);
  const float squared = dot(n, n);
  if (!(squared > 0)) return {1, 0, 0};
  const float u = dot(cross(corner[2] - corner[1], p - corner[1]), n) / squared;
  const float v = dot(cross(corner[0] - corner[2], p - corner[2]), n) / squared;
  return {u, v, 1 - u - v};
}

struct SurfaceDrawing {
  const DiagramOutput& output;
  Normalization normalize;
  std::vector<Vec3> normals;  // three a triangle of the domain
  std::vector<Colour> colours;
  float line_width;
  float outside;  // sign of the triangles' normals that point out of a closed surface; 0 if it is open
  Model model;

  Vec3 vertex(std::uint64_t v) const { return normalize(&output.cells.vertices[3 * v]); }
  Vec3 normal(std::uint32_t region, Vec3 at) const {
    const auto share = barycentric(at, corners(region));
    const Vec3* own = &normals[3 * std::size_t{region}];
    return normalized(own[0] * share[0] + own[1] * share[1] + own[2] * share[2]);
  }
  std::array<Vec3, 3> corners(std::uint32_t region) const {
    const RegionsView mesh = output.domain.regions();
    std::array<Vec3, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      corner[k] = normalize(&mesh.vertices[3 * std::size_t{mesh.region_vertex[3 * std::size_t{region} + k]}]);
    }
    return corner;
  }
  // Walls just behind the silhouette would else show as dots on it.
  bool out_of_sight(std::uint32_t region) const {
    const auto corner = corners(region);
    const Vec3 across = cross(corner[1] - corner[0], corner[2] - corner[0]) * outside;
    return outside != 0 && !faces_camera(corner[0], across);
  }
  void add_piece(std::uint32_t seed, std::uint64_t piece);
};

void SurfaceDrawing::add_piece(std::uint32_t seed, std::uint64_t piece) {
  const Cells& cells = output.cells;
  const std::uint64_t first = cells.vertex_offset[piece], end = cells.vertex_offset[piece + 1];
  const std::uint32_t region = cells.region[piece];
  for (std::uint64_t v = first + 1; v + 1 < end; ++v) {
    Model::Triangle triangle{{vertex(first), vertex(v), vertex(v + 1)}, {}, colours[seed]};
    for (std::size_t k = 0; k < 3; ++k) triangle.normal[k] = normal(region, triangle.corner[k]);
    model.triangles.push_back(triangle);
  }
  if (line_width <= 0 || out_of_sight(region)) return;
  for (std::uint64_t v = first; v < end; ++v) {
    const Border& border = cells.border[cells.face_offset[piece] + (v - first)];
    if (border.kind != Border::Kind::wall || border.index < seed) continue;  // each wall once
    model.lines.push_back({vertex(v), vertex(v + 1 < end ? v + 1 : first), ink, line_width});
  }
}

// Thinner lines for smaller cells; none where they would hide the cells.
float wall_line(const DiagramOutput& output) {
  const auto cells = static_cast<double>(std::max<std::size_t>(output.measures.count(SeedStatus::ok), 1));
  const double width = 80 / std::sqrt(cells);  // of a cell some 1200 / sqrt(cells) pixels wide
  return width < 0.25 ? 0.0f : static_cast<float>(std::clamp(width, 0.6, 3.2));
}

// By the sign of the volume inside.
float outward_sign(const RegionsView& mesh, const Normalization& normalize) {
  if (mesh.boundary_count > 0) return 0;
  double volume = 0;
  for (std::size_t t = 0; t < mesh.size(); ++t) {
    Vec3 p[3];
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = normalize(&mesh.vertices[3 * std::size_t{mesh.region_vertex[3 * t + k]}]);
    }
    volume += static_cast<double>(dot(p[0], cross(p[1], p[2])));
  }
  return volume < 0 ? -1.0f : 1.0f;
}

}  // namespace

Model surface_model(const DiagramOutput& output) {
  const Normalization normalize = normalization(output.domain);
  SurfaceDrawing drawing{output,
                         normalize,
                         corner_normals(output.domain.regions(), normalize),
                         cell_colours(output.adjacency, output.measures.mass.size()),
                         wall_line(output),
                         outward_sign(output.domain.regions(), normalize),
                         {}};
  for (std::size_t i = 0; i < output.cells.cell_count(); ++i) {
    for (std::uint64_t p = output.cells.cell_offset[i]; p < output.cells.cell_offset[i + 1]; ++p) {
      drawing.add_piece(static_cast<std::uint32_t>(i), p);
    }
  }
  return std::move(drawing.model);
}

void draw_surface(const std::string& path, const DiagramOutput& output) {
  const Image image = render(surface_model(output));
  write_pixels(path, image.rgb, image.width, image.height);
}

}  // namespace powercell::io
