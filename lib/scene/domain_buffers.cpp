#include "lib/scene/domain_buffers.hpp"

#include <algorithm>

namespace powercell {

namespace {

/// Sets the neighbours and faces of one vertex. `along[k]` is its neighbour along axis k, `facet[k]` the
/// facet that does not contain this neighbour. If the axes are right-handed, the neighbours x, z, y are
/// counter-clockwise seen from outside; `flip` says that they are left-handed.
void set_corner(region_shape_t& shape, int vertex, const int (&along)[3], const int (&facet)[3], bool flip) {
  const int order[3] = {0, flip ? 1 : 2, flip ? 2 : 1};
  for (int k = 0; k < 3; ++k) {
    const int missing = 3 - order[k] - order[(k + 1) % 3];  // the face between the two lacks this axis
    shape.next[k][vertex] = along[order[k]];
    shape.face[k][vertex] = facet[missing];
  }
}

}  // namespace

region_shape_t region_shape(RegionShape kind) {
  region_shape_t shape{};
  if (kind == RegionShape::tetrahedron) {
    shape.vertices = shape.faces = 4;
    // Even permutations of (0, 1, 2, 3) keep the orientation: each vertex sees the others as vertex 0 does.
    const int order[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}};
    for (const auto& o : order) set_corner(shape, o[0], {o[1], o[2], o[3]}, {o[1], o[2], o[3]}, false);
  } else if (kind == RegionShape::box) {
    shape.vertices = 8;
    shape.faces = 6;
    for (int v = 0; v < 8; ++v) {
      const int x = v & 1, y = v >> 1 & 1, z = v >> 2 & 1;
      set_corner(shape, v, {v ^ 1, v ^ 2, v ^ 4}, {x, 2 + y, 4 + z}, (x + y + z) % 2 == 1);
    }
  }
  return shape;
}

namespace {

/// The corner of triangle `region` opposite the edge that it shares with triangle `beside`, edge `slot`
/// there. Compares positions, since meshes may repeat vertices.
std::int32_t corner_off_edge(const RegionMesh& mesh, std::uint32_t region, std::uint32_t beside,
                             std::uint32_t slot) {
  const auto same = [&](std::uint32_t a, std::uint32_t b) {
    return std::equal(&mesh.vertices[a * 3], &mesh.vertices[a * 3] + 3, &mesh.vertices[b * 3]);
  };
  const std::uint32_t* ends = &mesh.region_vertex[mesh.region_offset[beside]];
  const std::uint32_t from = ends[slot], to = ends[(slot + 1) % 3];
  for (std::uint32_t k = mesh.region_offset[region]; k < mesh.region_offset[region + 1]; ++k) {
    const std::uint32_t corner = mesh.region_vertex[k];
    if (!same(corner, from) && !same(corner, to)) return static_cast<std::int32_t>(corner);
  }
  return BEHIND_NOTHING;  // only in a flat triangle, which domains do not contain
}

}  // namespace

std::vector<std::int32_t> regions_behind(const RegionMesh& mesh) {
  std::vector<std::int32_t> behind(mesh.facet.size(), BEHIND_NOTHING);
  for (std::uint32_t region = 0; region < mesh.region_count(); ++region)
    for (std::uint32_t f = mesh.facet_offset[region]; f < mesh.facet_offset[region + 1]; ++f) {
      if (mesh.facet[f].kind != Border::Kind::interior) continue;
      behind[f] = mesh.kind == DomainKind::surface
                      ? corner_off_edge(mesh, mesh.facet[f].index, region, f - mesh.facet_offset[region])
                      : 0;
    }
  return behind;
}

DomainBuffers::DomainBuffers(const std::shared_ptr<cl::Context>& context, const RegionMesh& mesh,
                             bool float32)
    : corners(context),
      region_offset(context),
      region_vertex(context),
      behind(context),
      shape(context),
      context_(context),
      mesh_(mesh),
      frame_(Frame::of(mesh, float32)) {
  const std::vector<std::byte> packed = frame_.pack(mesh.dimension, mesh.vertices, {});
  corners.reserve(packed.size());
  if (!packed.empty()) corners.write(packed.data(), packed.size());
  region_offset.upload(mesh.region_offset);
  region_vertex.upload(mesh.region_vertex);
  behind.upload(regions_behind(mesh));
  const region_shape_t start = region_shape(mesh.shape);
  shape.upload({&start, 1});
}

}  // namespace powercell
