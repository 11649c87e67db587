// Pictures of volumes: the cells of a diagram, opened.
#include <algorithm>
#include <cmath>

#include "apps/io/picture/colours.hpp"
#include "apps/io/picture/models.hpp"

namespace powercell::io {
namespace {

constexpr std::size_t most_apart = 20'000;  // with more cells the gaps would be finer than a pixel
constexpr float shrink = 0.88f;
// Cosines of the angles from which an edge is sharp: between walls, and between faces on the domain's
// boundary, which may be curved and cut into facets.
constexpr float wall_crease = 0.999f, boundary_crease = 0.8f;

// All cells but those whose centroid lies in the octant of the bounding box towards the camera; towards a
// camera that looks along a plane of the axes, in the quarter or the half.
std::vector<char> kept_cells(const DiagramOutput& output, const Normalization& normalize) {
  std::vector<char> kept(output.measures.mass.size(), 0);
  const Vec3 cut = normalized(output.style.towards);
  const auto is_front = [](float at, float towards) {
    constexpr float flat = 0.02f;
    return std::abs(towards) < flat || at * towards > 0;
  };
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!std::isfinite(output.measures.centroid[3 * i])) continue;
    const Vec3 c = normalize(&output.measures.centroid[3 * i]);
    kept[i] = !output.style.cut || !(is_front(c.x, cut.x) && is_front(c.y, cut.y) && is_front(c.z, cut.z));
  }
  // All cells of a small diagram may lie in that octant.
  if (std::find(kept.begin(), kept.end(), 1) == kept.end()) std::fill(kept.begin(), kept.end(), 1);
  return kept;
}

void add_face(Model& model, const std::vector<Vec3>& points, std::span<const std::uint32_t> loop,
              Colour colour, std::uint32_t cell, float crease) {
  Vec3 normal;
  for (std::size_t k = 1; k + 1 < loop.size(); ++k)
    normal = normal + cross(points[loop[k]] - points[loop[0]], points[loop[k + 1]] - points[loop[0]]);
  normal = normalized(normal);
  for (std::size_t k = 1; k + 1 < loop.size(); ++k)
    model.triangles.push_back({{points[loop[0]], points[loop[k]], points[loop[k + 1]]},
                               {normal, normal, normal},
                               colour,
                               cell,
                               crease});
}

}  // namespace

Model volume_model(const DiagramOutput& output) {
  const JoinedCells& joined = output.joined;
  const Normalization normalize = normalization(output.domain);
  const std::vector<Colour> colours = colouring_of(output).colour;
  const std::vector<char> kept = kept_cells(output, normalize);
  const std::size_t count = std::max<std::size_t>(output.measures.count(SeedStatus::ok), 1);
  const bool apart = count <= most_apart;
  Model model;
  model.line_ink = 0.62;
  if (count <= 200'000)
    model.line_width = static_cast<float>(std::clamp(22 / std::cbrt(static_cast<double>(count)), 0.5, 2.4));
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i + 1 < joined.face_offset.size(); ++i) {
    if (!kept[i] || output.measures.status[i] != SeedStatus::ok) continue;
    const Vec3 middle = normalize(&output.measures.centroid[3 * std::size_t{i}]);
    points.clear();
    for (std::uint64_t v = joined.vertex_offset[i]; v < joined.vertex_offset[i + 1]; ++v) {
      const Vec3 at = normalize(&joined.vertices[3 * v]);
      points.push_back(apart ? middle + (at - middle) * shrink : at);
    }
    for (std::uint64_t f = joined.face_offset[i]; f < joined.face_offset[i + 1]; ++f) {
      const Border& border = joined.face_border[f];
      const bool wall = border.kind == Border::Kind::wall;
      if (wall && !apart && kept[border.index]) continue;  // out of sight
      const auto loop =
          std::span(joined.loop)
              .subspan(joined.loop_offset[f], joined.loop_offset[f + 1] - joined.loop_offset[f]);
      add_face(model, points, loop, colours[i], i, wall ? wall_crease : boundary_crease);
    }
  }
  return model;
}

}  // namespace powercell::io
