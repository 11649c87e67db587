#include <powercell/diagram.hpp>
#include <string>

#include "lib/base/float_environment.hpp"
#include "lib/collect/join_faces.hpp"
#include "lib/collect/join_weld.hpp"

namespace powercell {
namespace {

void check(const Domain& domain, const Cells& cells) {
  if (domain.is_solid())
    throw Error(ErrorCode::invalid_argument,
                "a solid has no regions whose pieces could be joined; Diagram::joined() has the cells of its "
                "diagrams");
  if (cells.dimension == domain.dimension() && cells.cell_dimension == domain.cell_dimension()) return;
  throw Error(ErrorCode::invalid_argument, "cells of dimension " + std::to_string(cells.cell_dimension) +
                                               " in " + std::to_string(cells.dimension) +
                                               "D are not cells of the domain given, which has dimension " +
                                               std::to_string(domain.cell_dimension()) + " in " +
                                               std::to_string(domain.dimension()) +
                                               "D: join cells with the domain of their diagram");
}

/// Adds the faces of a cell and the vertices that they use, in the order of use.
void append(const CellWeld& weld, const JoinedFaces& faces, std::vector<std::uint32_t>& number,
            JoinedCells& out) {
  constexpr std::uint32_t none = ~std::uint32_t{0};
  const auto d = static_cast<std::size_t>(out.dimension);
  number.assign(weld.vertex_count(), none);
  std::uint32_t used = 0;
  const std::size_t base = out.loop.size();
  for (const std::uint32_t v : faces.loop) {
    if (number[v] == none) {
      number[v] = used++;
      out.vertices.insert(out.vertices.end(), weld.position(v), weld.position(v) + d);
    }
    out.loop.push_back(number[v]);
  }
  for (const std::size_t end : faces.end) out.loop_offset.push_back(base + end);
  out.face_border.insert(out.face_border.end(), faces.face_border.begin(), faces.face_border.end());
  out.edge_border.insert(out.edge_border.end(), faces.edge_border.begin(), faces.edge_border.end());
  out.vertex_offset.push_back(out.vertices.size() / d);
  out.face_offset.push_back(out.loop_offset.size() - 1);
}

}  // namespace

JoinedCells join_pieces(const Domain& domain, const Cells& cells) {
  JoinedCells out;
  out.dimension = cells.dimension;
  out.cell_dimension = cells.cell_dimension;
  out.vertex_offset = out.face_offset = out.loop_offset = {0};
  CellWeld weld(domain, cells);
  JoinedFaces faces;
  std::vector<std::uint32_t> number;
  for (std::size_t cell = 0; cell < cells.cell_count(); ++cell) {
    faces.clear();
    weld.weld(cell);
    if (domain.kind() == DomainKind::polygon) {
      join_rings(weld, faces);
    } else if (domain.kind() == DomainKind::surface) {
      join_triangles(weld, faces);
    } else {
      join_polyhedron(weld, faces);
    }
    append(weld, faces, number, out);
  }
  return out;
}

namespace {

/// A face per image: borders become numbers of faces, so that walls with images of one seed stay apart.
JoinedCells join_periodic(const Domain& domain, Cells cells) {
  const std::vector<Border> border = cells.border;
  for (std::size_t f = 0; f < border.size(); ++f)
    if (border[f].kind == Border::Kind::wall) cells.border[f].index = static_cast<std::uint32_t>(f);
  JoinedCells joined = join_pieces(domain, cells);
  std::vector<Border>& of_joined = joined.cell_dimension == 3 ? joined.face_border : joined.edge_border;
  joined.shift.resize(of_joined.size());
  for (std::size_t k = 0; k < of_joined.size(); ++k) {
    if (of_joined[k].kind != Border::Kind::wall) continue;
    const std::uint32_t f = of_joined[k].index;
    of_joined[k] = border[f];
    joined.shift[k] = cells.shift[f];
  }
  return joined;
}

}  // namespace

JoinedCells join(const Domain& domain, const Cells& cells) {
  const FloatEnvironment environment;
  check(domain, cells);
  return cells.shift.empty() ? join_pieces(domain, cells) : join_periodic(domain, cells);
}

}  // namespace powercell
