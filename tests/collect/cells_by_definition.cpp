#include "tests/collect/cells_by_definition.hpp"

#include "lib/domain/region_mesh.hpp"
#include "tests/support/brute_force.hpp"

namespace powercell::test {
namespace {

/// The half-space of a bisector in the domain's coordinates; bisector() is relative to seed i.
HalfSpace placed_bisector(const SeedsView& seeds, std::size_t i, std::size_t j) {
  HalfSpace half_space = bisector(seeds, i, j);
  const double* p = &seeds.positions[i * static_cast<std::size_t>(seeds.dimension)];
  half_space.offset += dot(half_space.normal, {p[0], p[1], seeds.dimension == 3 ? p[2] : 0.0});
  return half_space;
}

void append_faces(Cells& cells, const Polygon& piece) {
  cells.border.insert(cells.border.end(), piece.border.begin(), piece.border.end());
}

void append_faces(Cells& cells, const Polyhedron& piece) {
  for (const auto& face : piece.faces) {
    cells.border.push_back(face.border);
    cells.loop.insert(cells.loop.end(), face.ring.begin(), face.ring.end());
    cells.loop_offset.push_back(cells.loop.size());
  }
}

template <class Piece>
void append_cell(Cells& cells, const RegionMesh& mesh, const SeedsView& seeds, std::uint32_t i, double noise,
                 Random& random) {
  for (std::uint32_t r = 0; r < mesh.region_count(); ++r) {
    Piece piece;
    if constexpr (std::is_same_v<Piece, Polygon>)
      piece = region_polygon(mesh, r);
    else
      piece = region_polyhedron(mesh, r);
    for (std::uint32_t j = 0; j < seeds.size() && !piece.empty(); ++j)
      if (j != i) piece = clip(piece, placed_bisector(seeds, i, j), {Border::Kind::wall, j});
    if (!(moments(piece).measure > 1e-15L)) continue;
    cells.region.push_back(r);
    for (const Vec& v : piece.vertices) {
      const Real x[3] = {v.x, v.y, v.z};
      for (int k = 0; k < mesh.dimension; ++k)
        cells.vertices.push_back(static_cast<double>(x[k]) + noise * random.uniform(-1, 1));
    }
    append_faces(cells, piece);
    cells.vertex_offset.push_back(cells.vertices.size() / static_cast<std::size_t>(mesh.dimension));
    cells.face_offset.push_back(cells.border.size());
  }
}

}  // namespace

Cells cells_by_definition(const Domain& domain, const SeedsView& seeds, double noise) {
  const RegionMesh& mesh = domain.mesh();
  Random random(test_seed());
  Cells cells;
  cells.dimension = mesh.dimension;
  cells.cell_dimension = mesh.cell_dimension;
  cells.cell_offset = cells.vertex_offset = cells.face_offset = {0};
  if (mesh.cell_dimension == 3) cells.loop_offset = {0};
  for (std::uint32_t i = 0; i < seeds.size(); ++i) {
    if (mesh.cell_dimension == 2) {
      append_cell<Polygon>(cells, mesh, seeds, i, noise, random);
    } else {
      append_cell<Polyhedron>(cells, mesh, seeds, i, noise, random);
    }
    cells.cell_offset.push_back(cells.piece_count());
  }
  return cells;
}

Cells without_piece(const Cells& cells, std::uint64_t piece) {
  const auto d = static_cast<std::size_t>(cells.dimension);
  const auto cut = [](auto& values, std::size_t begin, std::size_t end) {
    values.erase(values.begin() + static_cast<std::ptrdiff_t>(begin),
                 values.begin() + static_cast<std::ptrdiff_t>(end));
  };
  const auto cut_offsets = [&](std::vector<std::uint64_t>& offset, std::size_t begin, std::size_t end) {
    const std::uint64_t gone = offset[end] - offset[begin];
    cut(offset, begin + 1, end + 1);
    for (std::size_t k = begin + 1; k < offset.size(); ++k) offset[k] -= gone;
  };
  Cells out = cells;
  const std::uint64_t face = cells.face_offset[piece], face_end = cells.face_offset[piece + 1];
  cut(out.vertices, d * cells.vertex_offset[piece], d * cells.vertex_offset[piece + 1]);
  cut(out.border, face, face_end);
  if (cells.cell_dimension == 3) {
    cut(out.loop, cells.loop_offset[face], cells.loop_offset[face_end]);
    cut_offsets(out.loop_offset, face, face_end);
  }
  cut(out.region, piece, piece + 1);
  cut_offsets(out.vertex_offset, piece, piece + 1);
  cut_offsets(out.face_offset, piece, piece + 1);
  for (std::uint64_t& offset : out.cell_offset) offset -= offset > piece;
  return out;
}

}  // namespace powercell::test
