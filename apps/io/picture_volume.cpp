#include <algorithm>
#include <cmath>
#include <map>

#include "apps/io/picture_cairo.hpp"
#include "apps/io/picture_normals.hpp"
#include "apps/io/picture_solid.hpp"

namespace powercell::io {
namespace {

constexpr std::size_t most_apart = 20'000;  // with more cells the gaps would be finer than a pixel
constexpr float shrink = 0.88f;
constexpr float crease = 0.8f;  // cosine of the angle from which an edge of the domain is sharp

struct VolumeDrawing {
  const DiagramOutput& output;
  Normalization normalize;
  std::vector<Colour> colours;
  std::vector<char> kept;
  bool apart;        // cells drawn towards their centroids
  float line_width;  // of the edges of cells
  Model model;

  Vec3 centroid(std::size_t cell) const { return normalize(&output.measures.centroid[3 * cell]); }
  bool in_sight(const Border& border) const {
    return apart || border.kind != Border::Kind::wall || !kept[border.index];
  }
  void add_cell(std::size_t cell);
  void add_edges(std::size_t cell, const std::vector<Vec3>& points, const std::vector<Vec3>& normals);
};

Vec3 loop_normal(const std::vector<Vec3>& points, std::span<const std::uint32_t> loop) {
  Vec3 sum;
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
    sum = sum + cross(points[loop[k]] - points[loop[0]], points[loop[k + 1]] - points[loop[0]]);
  }
  return normalized(sum);
}

std::span<const std::uint32_t> loop_of(const JoinedCells& joined, std::uint64_t face) {
  return std::span(joined.loop)
      .subspan(joined.loop_offset[face], joined.loop_offset[face + 1] - joined.loop_offset[face]);
}

void VolumeDrawing::add_cell(std::size_t cell) {
  const JoinedCells& joined = output.joined;
  const Vec3 middle = centroid(cell);
  std::vector<Vec3> points;
  for (std::uint64_t v = joined.vertex_offset[cell]; v < joined.vertex_offset[cell + 1]; ++v) {
    const Vec3 at = normalize(&joined.vertices[3 * v]);
    points.push_back(apart ? middle + (at - middle) * shrink : at);
  }
  std::vector<Vec3> normals;  // zero for faces out of sight
  for (std::uint64_t f = joined.face_offset[cell]; f < joined.face_offset[cell + 1]; ++f) {
    const auto loop = loop_of(joined, f);
    const Vec3 normal = loop_normal(points, loop);
    const bool seen = in_sight(joined.face_border[f]);
    normals.push_back(seen ? normal : Vec3{});
    for (std::size_t k = 1; seen && k + 1 < loop.size(); ++k) {
      model.triangles.push_back(
          {{points[loop[0]], points[loop[k]], points[loop[k + 1]]}, {normal, normal, normal}, colours[cell]});
    }
  }
  if (line_width > 0) add_edges(cell, points, normals);
}

// Edges between faces in different planes: a flat face of the domain may be cut into many. Two faces on the
// domain's boundary must meet at a crease: a curved boundary is not a heap of facets.
void VolumeDrawing::add_edges(std::size_t cell, const std::vector<Vec3>& points,
                              const std::vector<Vec3>& normals) {
  const JoinedCells& joined = output.joined;
  struct Side {
    Vec3 normal;
    bool boundary;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Side> open;  // edges met once, with that face
  for (std::size_t f = 0; f < normals.size(); ++f) {
    const std::uint64_t face = joined.face_offset[cell] + f;
    const Side side{normals[f], joined.face_border[face].kind == Border::Kind::boundary};
    const auto loop = loop_of(joined, face);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::uint32_t a = loop[k], b = loop[(k + 1) % loop.size()];
      const auto [at, first] = open.try_emplace(std::minmax(a, b), side);
      if (first) continue;
      const Side other = at->second;
      open.erase(at);
      const bool front = faces_camera(points[a], other.normal) || faces_camera(points[a], side.normal);
      const float flat = side.boundary && other.boundary ? crease : 0.999f;
      if (!front || dot(other.normal, side.normal) >= flat) continue;
      model.lines.push_back({points[a], points[b], mix(colours[cell], ink, 0.62), line_width});
    }
  }
}

// Cells whose centroid lies in the octant of the bounding box towards the camera are taken out.
std::vector<char> without_front_octant(const DiagramOutput& output, const Normalization& normalize) {
  const Vec3 view = view_direction();
  std::vector<char> kept(output.measures.mass.size(), 0);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!std::isfinite(output.measures.centroid[3 * i])) continue;
    const Vec3 c = normalize(&output.measures.centroid[3 * i]);
    kept[i] = !(c.x * view.x > 0 && c.y * view.y > 0 && c.z * view.z > 0);
  }
  // A diagram of a few cells may lie in that octant as a whole.
  if (std::find(kept.begin(), kept.end(), 1) == kept.end()) std::fill(kept.begin(), kept.end(), 1);
  return kept;
}

}  // namespace

Model volume_model(const DiagramOutput& output) {
  const Normalization normalize = normalization(output.domain);
  const std::size_t cells = std::max<std::size_t>(output.measures.count(SeedStatus::ok), 1);
  const double width = 22 / std::cbrt(static_cast<double>(cells));
  VolumeDrawing drawing{output,
                        normalize,
                        cell_colours(output.adjacency, output.measures.mass.size()),
                        without_front_octant(output, normalize),
                        cells <= most_apart,
                        cells <= 200'000 ? static_cast<float>(std::clamp(width, 0.5, 2.4)) : 0.0f,
                        {}};
  drawing.model.closed = true;
  for (std::size_t i = 0; i + 1 < output.joined.face_offset.size(); ++i) {
    if (drawing.kept[i] && output.measures.status[i] == SeedStatus::ok) drawing.add_cell(i);
  }
  return std::move(drawing.model);
}

void draw_volume(const std::string& path, const DiagramOutput& output) {
  const Image image = render(volume_model(output));
  write_pixels(path, image.rgb, image.width, image.height);
}

}  // namespace powercell::io
