#include "tests/support/compare_geometry.hpp"

#include <cmath>
#include <cstdio>
#include <map>
#include <span>
#include <utility>

#include "lib/domain/region_mesh.hpp"

namespace powercell::test {

namespace {

template <class... Args>
std::string text(const char* format, Args... args) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, format, args...);
  return buffer;
}

Vec point(const std::vector<double>& vertices, int dimension, std::size_t v) {
  const double* x = &vertices[v * static_cast<std::size_t>(dimension)];
  return {x[0], x[1], dimension == 3 ? x[2] : 0.0};
}

/// Twice the vector area of a ring.
Vec ring_area(const std::vector<Vec>& ring) {
  Vec twice;
  for (std::size_t k = 2; k < ring.size(); ++k)
    twice = twice + cross(ring[k - 1] - ring[0], ring[k] - ring[0]);
  return twice;
}

Vec region_normal(const RegionMesh& mesh, std::size_t region) {
  std::vector<Vec> ring;
  for (std::size_t k = mesh.region_offset[region]; k < mesh.region_offset[region + 1]; ++k)
    ring.push_back(point(mesh.vertices, mesh.dimension, mesh.region_vertex[k]));
  const Vec area = ring_area(ring);
  return (1 / length(area)) * area;
}

using Walls = std::map<std::pair<std::uint32_t, std::uint32_t>, Real>;

/// Checks of sizes, without which the arrays must not be read.
Differences check_sizes(const Cells& c, std::size_t seeds, std::size_t regions, bool loops) {
  Differences out;
  const std::size_t pieces = c.region.size();
  const bool fits =
      c.cell_offset.size() == seeds + 1 && c.cell_offset.back() == pieces &&
      c.vertex_offset.size() == pieces + 1 && c.face_offset.size() == pieces + 1 &&
      c.vertices.size() == c.vertex_offset.back() * static_cast<std::size_t>(c.dimension) &&
      c.border.size() == c.face_offset.back() &&
      (loops ? c.loop_offset.size() == c.border.size() + 1 && c.loop_offset.back() == c.loop.size()
             : c.loop_offset.empty() && c.loop.empty());
  if (!fits) out.push_back("sizes of the cells' arrays do not fit");
  for (const std::uint32_t r : c.region)
    if (r >= regions) out.push_back(text("region %u of %zu", r, regions));
  return out;
}

void check_border(Differences& out, const Border& border, std::uint32_t cell, std::size_t seeds,
                  const RegionMesh& mesh) {
  const std::size_t limit = border.kind == Border::Kind::wall       ? seeds
                            : border.kind == Border::Kind::boundary ? mesh.boundary_count
                                                                    : mesh.region_count();
  if (border.index >= limit)
    out.push_back(text("cell %u: border kind %u names %u of %zu", cell, static_cast<unsigned>(border.kind),
                       border.index, limit));
  if (border.kind == Border::Kind::wall && border.index == cell)
    out.push_back(text("cell %u borders itself", cell));
}

/// The signed area of a polygonal piece, on a surface along the triangle's normal. Adds its walls to `walls`.
Real polygon_piece(const Cells& c, std::size_t p, const RegionMesh& mesh, std::uint32_t cell, Walls& walls) {
  std::vector<Vec> ring;
  for (std::uint64_t v = c.vertex_offset[p]; v < c.vertex_offset[p + 1]; ++v)
    ring.push_back(point(c.vertices, c.dimension, v));
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Border& border = c.border[c.face_offset[p] + k];
    if (border.kind == Border::Kind::wall)
      walls[{cell, border.index}] += length(ring[(k + 1) % ring.size()] - ring[k]);
  }
  return dot(ring_area(ring), region_normal(mesh, c.region[p])) / 2;
}

/// The volume inside the faces [first, last), given as loops; checks that their edges cancel in pairs.
Real closed_volume(Differences& out, std::uint32_t cell, const std::vector<Vec>& vertices,
                   std::span<const std::uint64_t> loop_offset, const std::vector<std::uint32_t>& loop,
                   const auto& on_face) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  Real six = 0;
  for (std::size_t f = 0; f + 1 < loop_offset.size(); ++f) {
    std::vector<Vec> ring;
    for (std::uint64_t k = loop_offset[f]; k < loop_offset[f + 1]; ++k) {
      const std::uint64_t next = k + 1 < loop_offset[f + 1] ? k + 1 : loop_offset[f];
      if (loop[k] >= vertices.size()) {
        out.push_back(text("cell %u: loop names vertex %u of %zu", cell, loop[k], vertices.size()));
        return 0;
      }
      ring.push_back(vertices[loop[k]]);
      ++edges[{loop[k], loop[next]}];
      --edges[{loop[next], loop[k]}];
    }
    if (ring.size() < 3) out.push_back(text("cell %u: a face of %zu vertices", cell, ring.size()));
    const Vec twice = ring_area(ring);
    six += dot(twice, ring[0] - vertices[0]);
    on_face(f, length(twice) / 2);
  }
  for (const auto& [edge, count] : edges)
    if (count != 0) {
      out.push_back(text("cell %u: its faces do not close at the edge %u-%u", cell, edge.first, edge.second));
      break;
    }
  return six / 6;
}

Real polyhedron_piece(Differences& out, const Cells& c, std::size_t p, std::uint32_t cell, Walls& walls) {
  std::vector<Vec> vertices;
  for (std::uint64_t v = c.vertex_offset[p]; v < c.vertex_offset[p + 1]; ++v)
    vertices.push_back(point(c.vertices, c.dimension, v));
  const std::uint64_t first = c.face_offset[p], last = c.face_offset[p + 1];
  const std::span<const std::uint64_t> offsets(&c.loop_offset[first], last - first + 1);
  return closed_volume(out, cell, vertices, offsets, c.loop, [&](std::size_t f, Real area) {
    const Border& border = c.border[first + f];
    if (border.kind == Border::Kind::wall) walls[{cell, border.index}] += area;
  });
}

void compare_piece_walls(Differences& out, Walls walls, const Adjacency& adjacency,
                         const Tolerances& tolerances) {
  for (std::uint32_t i = 0; i + 1 < adjacency.offset.size(); ++i)
    for (std::uint64_t k = adjacency.offset[i]; k < adjacency.offset[i + 1]; ++k)
      walls[{i, adjacency.neighbor[k]}] -= adjacency.wall[k];
  for (const auto& [pair, defect] : walls)
    if (!(std::abs(static_cast<double>(defect)) <= tolerances.wall_from_geometry(pair.first, pair.second)))
      out.push_back(text("wall %u-%u: its faces differ from the adjacency by %.3g", pair.first, pair.second,
                         static_cast<double>(defect)));
}

}  // namespace

Differences check_cells(const Cells& cells, const Domain& domain, const Measures& measures,
                        const Adjacency& adjacency, const Tolerances& tolerances) {
  const RegionMesh& mesh = domain.mesh();
  const std::size_t n = measures.mass.size();
  const bool solid = domain.cell_dimension() == 3;
  if (cells.dimension != domain.dimension() || cells.cell_dimension != domain.cell_dimension())
    return {"wrong dimensions of the cells"};
  Differences out = check_sizes(cells, n, mesh.region_count(), solid);
  if (!out.empty()) return out;
  Walls walls;
  for (std::uint32_t i = 0; i < n; ++i) {
    Real sum = 0;
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p) {
      for (std::uint64_t f = cells.face_offset[p]; f < cells.face_offset[p + 1]; ++f)
        check_border(out, cells.border[f], i, n, mesh);
      const Real part =
          solid ? polyhedron_piece(out, cells, p, i, walls) : polygon_piece(cells, p, mesh, i, walls);
      if (part < -tolerances.mass_from_geometry(i))
        out.push_back(text("cell %u: a piece of measure %.3g", i, static_cast<double>(part)));
      sum += part;
    }
    if (!(std::abs(static_cast<double>(sum) - measures.mass[i]) <= tolerances.mass_from_geometry(i)))
      out.push_back(text("cell %u: its pieces measure %.17g, not %.17g", i, static_cast<double>(sum),
                         measures.mass[i]));
  }
  compare_piece_walls(out, std::move(walls), adjacency, tolerances);
  return out;
}

namespace {

std::vector<Vec> joined_vertices(const JoinedCells& j, std::size_t cell) {
  std::vector<Vec> vertices;
  for (std::uint64_t v = j.vertex_offset[cell]; v < j.vertex_offset[cell + 1]; ++v)
    vertices.push_back(point(j.vertices, j.dimension, v));
  return vertices;
}

/// The area of a polygon cell (rings are signed) or of a surface cell (a face in each triangle). Sets
/// `interior` to the length of the interior edges left in a polygon cell.
Real joined_area(const JoinedCells& j, std::uint32_t cell, const std::vector<Vec>& vertices, DomainKind kind,
                 Real& interior) {
  Real sum = 0;
  for (std::uint64_t f = j.face_offset[cell]; f < j.face_offset[cell + 1]; ++f) {
    std::vector<Vec> ring;
    for (std::uint64_t k = j.loop_offset[f]; k < j.loop_offset[f + 1]; ++k) {
      if (j.loop[k] >= vertices.size()) return NAN;
      ring.push_back(vertices[j.loop[k]]);
    }
    for (std::uint64_t k = j.loop_offset[f]; kind == DomainKind::polygon && k < j.loop_offset[f + 1]; ++k) {
      const std::size_t at = k - j.loop_offset[f];
      if (j.edge_border[k].kind == Border::Kind::interior)
        interior += length(ring[(at + 1) % ring.size()] - ring[at]);
    }
    const Vec twice = ring_area(ring);
    sum += kind == DomainKind::polygon ? twice.z / 2 : length(twice) / 2;
  }
  return sum;
}

/// The volume of a joined cell. Sets `interior` to the area of the interior faces left.
Real joined_volume(Differences& out, const JoinedCells& j, std::uint32_t cell,
                   const std::vector<Vec>& vertices, Real& interior) {
  const std::uint64_t first = j.face_offset[cell], last = j.face_offset[cell + 1];
  if (first == last) return 0;
  const std::span<const std::uint64_t> offsets(&j.loop_offset[first], last - first + 1);
  return closed_volume(out, cell, vertices, offsets, j.loop, [&](std::size_t f, Real area) {
    if (j.face_border[first + f].kind == Border::Kind::interior) interior += area;
  });
}

}  // namespace

Differences check_joined(const JoinedCells& joined, const Domain& domain, const Measures& measures,
                         const Tolerances& tolerances) {
  Differences out;
  const std::size_t n = measures.mass.size();
  const bool solid = domain.cell_dimension() == 3;
  if (joined.vertex_offset.size() != n + 1 || joined.face_offset.size() != n + 1 ||
      joined.loop_offset.size() != joined.face_offset.back() + 1 ||
      joined.loop.size() != joined.loop_offset.back() ||
      (solid ? joined.face_border.size() != joined.face_offset.back()
             : joined.edge_border.size() != joined.loop.size()))
    return {"sizes of the joined cells' arrays do not fit"};
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::vector<Vec> vertices = joined_vertices(joined, i);
    Real interior = 0;
    const Real sum = solid ? joined_volume(out, joined, i, vertices, interior)
                           : joined_area(joined, i, vertices, domain.kind(), interior);
    // Pieces no thicker than rounding may lack their counterparts.
    if (!(static_cast<double>(interior) <= tolerances.wall_from_geometry(i, i)))
      out.push_back(
          text("joined cell %u: interior faces of measure %.3g are left", i, static_cast<double>(interior)));
    if (!(std::abs(static_cast<double>(sum) - measures.mass[i]) <= tolerances.mass_from_geometry(i)))
      out.push_back(
          text("joined cell %u measures %.17g, not %.17g", i, static_cast<double>(sum), measures.mass[i]));
  }
  return out;
}

}  // namespace powercell::test
