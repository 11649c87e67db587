// Two meshes of one surface beside each other.
#include <algorithm>
#include <cmath>

#include "apps/io/picture_cairo.hpp"
#include "apps/io/picture_normals.hpp"
#include "apps/io/picture_render.hpp"
#include "apps/io/write_triangles.hpp"

namespace powercell::io {
namespace {

constexpr Colour clay{0xe8, 0xc9, 0xa0};

Vec3 corner_of(const TriangleMesh& mesh, std::size_t t, std::size_t k, const Normalization& normalize) {
  return normalize(&mesh.vertices[3 * std::size_t{mesh.triangles[t + k]}]);
}

/// Which way normals point out of a closed mesh: the sign of its volume; 0 if it is open.
float outward_sign(const TriangleMesh& mesh, const RegionsView& regions, const Normalization& normalize) {
  if (regions.boundary_count > 0) return 0;
  double volume = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    volume +=
        static_cast<double>(dot(corner_of(mesh, t, 0, normalize),
                                cross(corner_of(mesh, t, 1, normalize), corner_of(mesh, t, 2, normalize))));
  return volume < 0 ? -1.0f : 1.0f;
}

Model model_of(const TriangleMesh& mesh, const Normalization& normalize) {
  const Domain domain = Domain::surface(mesh.vertices, mesh.triangles);
  const std::vector<Vec3> normals = corner_normals(domain.regions(), normalize);
  const float outside = outward_sign(mesh, domain.regions(), normalize);
  // Of an edge some 1000 / sqrt(triangles) pixels long.
  const float width = static_cast<float>(
      std::clamp(70 / std::sqrt(static_cast<double>(mesh.triangles.size() / 3)), 0.5, 2.5));
  Model model;
  for (std::size_t r = 0; r < domain.region_count(); ++r) {
    const std::size_t t = 3 * std::size_t{domain.regions().source[r]};
    Model::Triangle triangle{{}, {}, clay};
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.corner[k] = corner_of(mesh, t, k, normalize);
      triangle.normal[k] = normals[3 * r + k];
    }
    model.triangles.push_back(triangle);
    // Edges just behind the silhouette would else show as dots on it.
    const Vec3 across =
        cross(triangle.corner[1] - triangle.corner[0], triangle.corner[2] - triangle.corner[0]);
    if (outside != 0 && !faces_camera(triangle.corner[0], across * outside)) continue;
    for (std::size_t k = 0; k < 3; ++k)
      model.lines.push_back({triangle.corner[k], triangle.corner[(k + 1) % 3], ink, width});
  }
  return model;
}

}  // namespace

void draw_before_and_after(const std::string& path, const TriangleMesh& before, const TriangleMesh& after) {
  const Normalization normalize = normalization(Domain::surface(before.vertices, before.triangles));
  constexpr int side = 1100;
  const Image images[] = {render(model_of(before, normalize), side),
                          render(model_of(after, normalize), side)};
  const int width = images[0].width + images[1].width, height = std::max(images[0].height, images[1].height);
  std::vector<std::uint8_t> rgb(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 255);
  int left = 0;
  for (const Image& image : images) {
    const int top = (height - image.height) / 2;
    for (int y = 0; y < image.height; ++y)
      std::copy_n(&image.rgb[3 * static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width)],
                  3 * static_cast<std::size_t>(image.width),
                  &rgb[3 * (static_cast<std::size_t>(top + y) * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(left))]);
    left += image.width;
  }
  write_pixels(path, rgb, width, height);
}

}  // namespace powercell::io
