#include "apps/io/page/mesh.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <unordered_map>
#include <unordered_set>

#include "apps/io/picture/normals.hpp"

namespace powercell::io {
namespace {

using Normal = std::array<std::int8_t, 3>;

/// What makes points one: coordinates with the same bits, and the same normal.
struct PointKey {
  std::array<std::uint32_t, 3> bits{};
  Normal normal{};
  friend bool operator==(const PointKey&, const PointKey&) = default;
};

struct PointHash {
  std::size_t operator()(const PointKey& key) const {
    std::uint64_t h = 0;
    const auto enter = [&h](std::uint64_t value) {
      h = (h ^ value) * 0x9e3779b97f4a7c15u;
      h ^= h >> 29;
    };
    for (const std::uint32_t bits : key.bits) enter(bits);
    for (const std::int8_t part : key.normal) enter(static_cast<std::uint8_t>(part));
    return h;
  }
};

class MeshMaker {
 public:
  MeshMaker(const DiagramOutput& output, std::size_t points) {
    const Domain& domain = output.domain;
    mesh_.dimension = domain.dimension();
    const auto low = domain.low(), high = domain.high();
    double half = 0;
    for (std::size_t k = 0; k < d(); ++k) {
      mesh_.offset[k] = low[k] + (high[k] - low[k]) / 2;
      half = std::hypot(half, (high[k] - low[k]) / 2);
    }
    int exponent = 0;
    std::frexp(half > 0 ? half : 1, &exponent);
    mesh_.scale = std::ldexp(1.0, exponent);
    known_.reserve(points / 3);
  }

  void corner(const double* point, const Normal& normal = {}) {
    PointKey key;
    key.normal = normal;
    std::array<float, 3> at{};
    for (std::size_t k = 0; k < d(); ++k) {
      at[k] = static_cast<float>((point[k] - mesh_.offset[k]) / mesh_.scale) + 0.0f;  // no negative zero
      key.bits[k] = std::bit_cast<std::uint32_t>(at[k]);
    }
    const auto [found, is_new] = known_.emplace(key, static_cast<std::int32_t>(known_.size()));
    if (is_new) {
      mesh_.points.insert(mesh_.points.end(), at.begin(), at.begin() + mesh_.dimension);
      if (with_normals_) mesh_.normals.insert(mesh_.normals.end(), normal.begin(), normal.end());
    }
    if (face_.empty() || face_.back() != found->second) face_.push_back(found->second);
  }

  /// Ends a face; one without three different corners is left out.
  void end_face(std::size_t inner, std::int32_t outer = -1) {
    while (face_.size() > 1 && face_.back() == face_.front()) face_.pop_back();
    if (face_.size() > 2) {
      mesh_.corners.insert(mesh_.corners.end(), face_.begin(), face_.end());
      mesh_.sizes.push_back(static_cast<std::int32_t>(face_.size()));
      mesh_.inner.push_back(static_cast<std::int32_t>(inner));
      if (with_outer_) mesh_.outer.push_back(outer);
    }
    face_.clear();
  }

  std::size_t d() const { return static_cast<std::size_t>(mesh_.dimension); }
  void with_normals() { with_normals_ = true; }
  void with_outer() { with_outer_ = true; }
  ViewMesh take() { return std::move(mesh_); }

 private:
  ViewMesh mesh_;
  std::unordered_map<PointKey, std::int32_t, PointHash> known_;
  std::vector<std::int32_t> face_;
  bool with_normals_ = false, with_outer_ = false;
};

Normal small(Vec3 normal) {
  const auto part = [](float value) { return static_cast<std::int8_t>(std::lround(127 * value)); };
  return {part(normal.x), part(normal.y), part(normal.z)};
}

ViewMesh mesh_of_polygons(const DiagramOutput& output) {
  const Cells& cells = output.cells;
  MeshMaker maker(output, cells.vertices.size());
  for (std::size_t i = 0; i < cells.cell_count(); ++i)
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p) {
      for (std::uint64_t v = cells.vertex_offset[p]; v < cells.vertex_offset[p + 1]; ++v)
        maker.corner(&cells.vertices[maker.d() * v]);
      maker.end_face(i);
    }
  return maker.take();
}

ViewMesh mesh_of_surface(const DiagramOutput& output) {
  const Cells& cells = output.cells;
  const Normalization normalize = normalization(output.domain);
  const RegionsView regions = output.domain.regions();
  const std::vector<Vec3> normals = corner_normals(regions, normalize);
  MeshMaker maker(output, cells.vertices.size());
  maker.with_normals();
  for (std::size_t i = 0; i < cells.cell_count(); ++i)
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p) {
      const TriangleNormals normal_at(regions, normals, normalize, cells.region[p]);
      for (std::uint64_t v = cells.vertex_offset[p]; v < cells.vertex_offset[p + 1]; ++v) {
        const double* point = &cells.vertices[3 * v];
        maker.corner(point, small(normal_at(normalize(point))));
      }
      maker.end_face(i);
    }
  return maker.take();
}

bool is_in_place(const JoinedCells& joined, std::uint64_t face) {
  return joined.shift.empty() || joined.shift[face] == std::array<std::int32_t, 3>{};
}

ViewMesh mesh_of_volume(const DiagramOutput& output) {
  const JoinedCells& joined = output.joined;
  MeshMaker maker(output, joined.vertices.size());
  maker.with_outer();
  std::unordered_set<std::uint64_t> drawn;  // pairs of cells, the lower number first
  for (std::size_t i = 0; i + 1 < joined.face_offset.size(); ++i)
    for (std::uint64_t f = joined.face_offset[i]; f < joined.face_offset[i + 1]; ++f) {
      const Border& border = joined.face_border[f];
      const bool shared = border.kind == Border::Kind::wall && is_in_place(joined, f);
      // The cell of lower number has the wall, unless rounding took it from there.
      if (shared && border.index < i && drawn.contains(std::uint64_t{border.index} << 32 | i)) continue;
      if (shared && border.index > i) drawn.insert(std::uint64_t{i} << 32 | border.index);
      for (std::uint64_t e = joined.loop_offset[f]; e < joined.loop_offset[f + 1]; ++e)
        maker.corner(&joined.vertices[3 * (joined.vertex_offset[i] + joined.loop[e])]);
      maker.end_face(i, shared ? static_cast<std::int32_t>(border.index) : -1);
    }
  return maker.take();
}

}  // namespace

ViewMesh view_mesh(const DiagramOutput& output) {
  switch (output.domain.kind()) {
    case DomainKind::polygon:
      return mesh_of_polygons(output);
    case DomainKind::surface:
      return mesh_of_surface(output);
    case DomainKind::volume:
      return mesh_of_volume(output);
  }
  return {};
}

}  // namespace powercell::io
