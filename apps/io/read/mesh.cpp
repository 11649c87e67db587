#include "apps/io/read/mesh.hpp"

#include <fmt/format.h>

#include <limits>

#include "apps/io/read/file.hpp"

namespace powercell::io {

std::size_t checked_vertex_count(std::uint64_t count, const std::string& name) {
  if (count > std::numeric_limits<std::uint32_t>::max()) {
    fail_file(name, fmt::format("{} vertices are more than 32-bit indices can address", count));
  }
  return static_cast<std::size_t>(count);
}

MeshArrays choose_elements(MeshFile mesh, std::optional<DomainKind> kind, const std::string& name) {
  if (kind == DomainKind::polygon) {
    fail_file(name, "holds a mesh in space, not a polygon; choose surface or volume as the kind");
  }
  MeshArrays arrays;
  const bool solids = !mesh.tetrahedra.empty() || !mesh.other_solid.empty();
  arrays.kind = kind.value_or(solids ? DomainKind::volume : DomainKind::surface);
  if (arrays.kind == DomainKind::volume) {
    if (mesh.other_is_quadratic)
      fail_file(name, fmt::format("has {}; if edges are straight, its corners are enough, and meshio keeps "
                                  "these alone: python3 -c "
                                  "\"import meshio; m = meshio.read('{}'); meshio.Mesh(m.points, [('tetra', "
                                  "c.data[:, :4]) for c in "
                                  "m.cells if c.type.startswith('tetra')]).write('linear.vtu')\"",
                                  mesh.other_solid, name));
    if (!mesh.other_solid.empty()) {
      fail_file(name,
                fmt::format("has {}; only tetrahedra make a volume: split the other cells into tetrahedra",
                            mesh.other_solid));
    }
    if (mesh.tetrahedra.empty()) fail_file(name, "has no tetrahedra; its faces are a surface");
    arrays.elements = std::move(mesh.tetrahedra);
  } else {
    if (mesh.face_count() == 0) {
      fail_file(name, solids ? "has no faces besides those of its solids; it is a volume, not a surface"
                             : "has neither tetrahedra nor faces; a cloud of points is no domain, but its "
                               "points may be seeds");
    }
    arrays.elements = triangulate(mesh, name);
  }
  arrays.vertices = std::move(mesh.vertices);
  return arrays;
}

}  // namespace powercell::io
