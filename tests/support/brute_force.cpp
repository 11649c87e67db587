#include "tests/support/brute_force.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace powercell::test {

namespace {

Vec position(const SeedsView& seeds, std::size_t i) {
  const double* p = &seeds.positions[i * static_cast<std::size_t>(seeds.dimension)];
  return {p[0], p[1], seeds.dimension == 3 ? p[2] : 0.0};
}

Real weight(const SeedsView& seeds, std::size_t i) {
  return seeds.weights.empty() ? 0.0 : seeds.weights[i];
}

/// Equal positions: the largest weight wins, then the lowest index.
std::vector<SeedStatus> find_duplicates(const SeedsView& seeds) {
  std::vector<SeedStatus> status(seeds.size(), SeedStatus::ok);
  std::map<std::array<double, 3>, std::size_t> best;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    std::array<double, 3> key{0, 0, 0};
    for (int k = 0; k < seeds.dimension; ++k)
      key[static_cast<std::size_t>(k)] =
          seeds.positions[i * static_cast<std::size_t>(seeds.dimension) + static_cast<std::size_t>(k)] + 0.0;
    const auto [entry, fresh] = best.try_emplace(key, i);
    if (fresh) continue;
    const bool wins = weight(seeds, i) > weight(seeds, entry->second);
    status[wins ? entry->second : i] = SeedStatus::duplicate;
    if (wins) entry->second = i;
  }
  return status;
}

Vec region_vertex(const RegionMesh& mesh, std::size_t region, std::size_t k) {
  const std::size_t v = mesh.region_vertex[mesh.region_offset[region] + k];
  const double* x = &mesh.vertices[v * static_cast<std::size_t>(mesh.dimension)];
  return {x[0], x[1], mesh.dimension == 3 ? x[2] : 0.0};
}

}  // namespace

Polygon region_polygon(const RegionMesh& mesh, std::size_t region, const Vec& origin) {
  Polygon polygon;
  const std::size_t n = mesh.region_offset[region + 1] - mesh.region_offset[region];
  for (std::size_t k = 0; k < n; ++k) {
    polygon.vertices.push_back(region_vertex(mesh, region, k) - origin);
    polygon.border.push_back(mesh.facet[mesh.facet_offset[region] + k]);
  }
  return polygon;
}

Polyhedron region_polyhedron(const RegionMesh& mesh, std::size_t region, const Vec& origin) {
  // Outward rings: tetrahedron facet k opposite vertex k; box -x +x -y +y -z +z, corner bits x, y, z.
  static const std::vector<std::vector<std::uint32_t>> tetrahedron = {
      {1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  static const std::vector<std::vector<std::uint32_t>> box = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                                              {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  Polyhedron polyhedron;
  const std::size_t n = mesh.region_offset[region + 1] - mesh.region_offset[region];
  for (std::size_t k = 0; k < n; ++k) polyhedron.vertices.push_back(region_vertex(mesh, region, k) - origin);
  const auto& rings = mesh.shape == RegionShape::box ? box : tetrahedron;
  for (std::size_t f = 0; f < rings.size(); ++f)
    polyhedron.faces.push_back({rings[f], mesh.facet[mesh.facet_offset[region] + f]});
  return polyhedron;
}

namespace {

using Corner = std::array<std::uint32_t, 4>;

Corner corner_of(std::vector<std::uint32_t> seeds) {
  std::sort(seeds.begin(), seeds.end());
  Corner corner;
  for (std::size_t k = 0; k < 4; ++k) corner[k] = seeds[std::min(k, seeds.size() - 1)];
  return corner;
}

template <class Visit>
void for_each_interior_side(Polygon& piece, Visit visit) {
  for (std::size_t k = 0; k < piece.vertices.size(); ++k)
    if (piece.border[k].kind == Border::Kind::interior)
      visit(piece.border[k], {piece.vertices[k], piece.vertices[(k + 1) % piece.vertices.size()]});
}

template <class Visit>
void for_each_interior_side(Polyhedron& piece, Visit visit) {
  for (Polyhedron::Face& face : piece.faces) {
    if (face.border.kind != Border::Kind::interior) continue;
    std::vector<Vec> corners;
    for (const std::uint32_t v : face.ring) corners.push_back(piece.vertices[v]);
    visit(face.border, corners);
  }
}

/// How far the rim of a wall moves within the wall's plane if the two planes that meet there, at an angle
/// with this sine, move by 1.
Real rim_speed(Real sine) {
  constexpr Real least = 1e-9L;  // planes of a corner that rounding has made
  return 2 / std::max(sine, least);
}

/// The direction of the first edge of positive length from `k` on, stepping by `step`. Ties leave edges of
/// length 0.
Vec edge_direction(const Polygon& piece, std::size_t k, std::size_t step) {
  const std::size_t n = piece.vertices.size();
  for (std::size_t tries = 0; tries < n; ++tries, k = (k + step) % n) {
    const Vec edge = piece.vertices[(k + 1) % n] - piece.vertices[k];
    if (length(edge) > 0) return (1 / length(edge)) * edge;
  }
  return {};
}

void record(ReferenceDiagram& diagram, std::uint32_t i, const Polygon& piece) {
  const std::size_t n = piece.vertices.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Real wall = edge_length(piece, k);
    diagram.surface[i] += wall;
    if (piece.border[k].kind != Border::Kind::wall || wall == 0) continue;
    const std::uint32_t j = piece.border[k].index;
    diagram.wall[{i, j}] += wall;
    const Vec along = edge_direction(piece, k, 1);
    diagram.rim[{i, j}] += rim_speed(length(cross(along, edge_direction(piece, (k + n - 1) % n, n - 1)))) +
                           rim_speed(length(cross(along, edge_direction(piece, (k + 1) % n, 1))));
    const Border& next = piece.border[(k + 1) % n];
    if (next.kind == Border::Kind::wall && next.index != j)
      diagram.simplices.insert(corner_of({i, j, next.index}));
  }
}

/// Unit normals of the faces; zero for faces of area 0, which ties leave.
std::vector<Vec> face_normals(const Polyhedron& piece) {
  std::vector<Vec> normals;
  for (std::size_t f = 0; f < piece.faces.size(); ++f) {
    const Vec twice = twice_face_area(piece, f);
    normals.push_back(length(twice) > 0 ? (1 / length(twice)) * twice : Vec{});
  }
  return normals;
}

/// The rim speeds of all faces summed over their edges.
std::vector<Real> rims(const Polyhedron& piece) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> face_at;
  const auto each_edge = [&](auto visit) {
    for (std::size_t f = 0; f < piece.faces.size(); ++f) {
      const auto& ring = piece.faces[f].ring;
      for (std::size_t k = 0; k < ring.size(); ++k) visit(f, ring[k], ring[(k + 1) % ring.size()]);
    }
  };
  each_edge([&](std::size_t f, std::uint32_t a, std::uint32_t b) { face_at[{a, b}] = f; });
  const std::vector<Vec> normals = face_normals(piece);
  std::vector<Real> sum(piece.faces.size(), 0);
  each_edge([&](std::size_t f, std::uint32_t a, std::uint32_t b) {
    const Vec& other = normals[face_at.at({b, a})];
    const Real edge = length(piece.vertices[b] - piece.vertices[a]);
    if (length(normals[f]) > 0 && length(other) > 0)
      sum[f] += edge * rim_speed(length(cross(normals[f], other)));
  });
  return sum;
}

void record(ReferenceDiagram& diagram, std::uint32_t i, const Polyhedron& piece) {
  std::vector<std::set<std::uint32_t>> walls_at(piece.vertices.size());
  std::vector<int> faces_at(piece.vertices.size(), 0);
  const std::vector<Real> rim = rims(piece);
  for (std::size_t f = 0; f < piece.faces.size(); ++f) {
    const Real area = face_area(piece, f);
    diagram.surface[i] += area;
    const Border& border = piece.faces[f].border;
    for (const std::uint32_t v : piece.faces[f].ring) {
      ++faces_at[v];
      if (border.kind == Border::Kind::wall) walls_at[v].insert(border.index);
    }
    if (border.kind != Border::Kind::wall) continue;
    diagram.wall[{i, border.index}] += area;
    diagram.rim[{i, border.index}] += rim[f];
  }
  for (std::size_t v = 0; v < walls_at.size(); ++v) {
    if (walls_at[v].size() != 3 || faces_at[v] != 3) continue;
    std::vector<std::uint32_t> corner(walls_at[v].begin(), walls_at[v].end());
    corner.push_back(i);
    diagram.simplices.insert(corner_of(std::move(corner)));
  }
}

/// Marks sides of the region that lie in a bisector as walls, in the region on seed i's side.
template <class Piece>
void name_walls_in_facets(Piece& piece, const SeedsView& seeds, std::uint32_t i,
                          std::span<const std::uint32_t> candidates, const std::vector<SeedStatus>& status) {
  constexpr Real rounding = 64 * std::numeric_limits<Real>::epsilon();
  for_each_interior_side(piece, [&](Border& border, const std::vector<Vec>& corners) {
    for (const std::uint32_t j : candidates) {
      if (j == i || status[j] == SeedStatus::duplicate) continue;
      const HalfSpace half = bisector(seeds, i, j);
      const bool lies_in = std::all_of(corners.begin(), corners.end(), [&](const Vec& y) {
        return std::abs(half.excess(y)) <=
               rounding * (length(half.normal) * length(y) + std::abs(half.offset));
      });
      if (!lies_in) continue;
      border = {Border::Kind::wall, j};
      return;
    }
  });
}

/// Cuts `piece` by every candidate and adds the rest to seed i.
template <class Piece>
void cut_piece(ReferenceDiagram& diagram, const SeedsView& seeds, std::uint32_t i, Piece piece,
               std::span<const std::uint32_t> candidates) {
  for (const std::uint32_t j : candidates) {
    if (j == i || diagram.status[j] == SeedStatus::duplicate) continue;
    piece = clip(std::move(piece), bisector(seeds, i, j), {Border::Kind::wall, j});
    if (piece.empty()) return;
  }
  const Moments sum = moments(piece);
  if (!(sum.measure > 0)) return;
  name_walls_in_facets(piece, seeds, i, candidates, diagram.status);
  diagram.mass[i] += sum.measure;
  diagram.first[i] = diagram.first[i] + sum.first;
  diagram.second_moment[i] += sum.second;
  record(diagram, i, piece);
}

ReferenceDiagram start(const SeedsView& seeds) {
  ReferenceDiagram diagram;
  const std::size_t n = seeds.size();
  diagram.mass.assign(n, 0);
  diagram.first.assign(n, {});
  diagram.second_moment.assign(n, 0);
  diagram.surface.assign(n, 0);
  diagram.status = find_duplicates(seeds);
  return diagram;
}

void cut_seed(ReferenceDiagram& diagram, const RegionMesh& mesh, const SeedsView& seeds, std::uint32_t i,
              std::span<const std::uint32_t> candidates) {
  if (diagram.status[i] == SeedStatus::duplicate) return;
  const Vec origin = position(seeds, i);
  for (std::size_t r = 0; r < mesh.region_count(); ++r) {
    if (mesh.shape == RegionShape::polygon)
      cut_piece(diagram, seeds, i, region_polygon(mesh, r, origin), candidates);
    else
      cut_piece(diagram, seeds, i, region_polyhedron(mesh, r, origin), candidates);
  }
  if (!(diagram.mass[i] > 0)) diagram.status[i] = SeedStatus::hidden;
}

}  // namespace

Real ReferenceDiagram::total() const {
  return std::accumulate(mass.begin(), mass.end(), Real{0});
}

HalfSpace bisector(const SeedsView& seeds, std::size_t i, std::size_t j) {
  const Vec q = position(seeds, j) - position(seeds, i);
  // Subtracts the weights first, so that a large constant in both cancels exactly.
  return {2 * q, dot(q, q) + (weight(seeds, i) - weight(seeds, j))};
}

ReferenceDiagram brute_force(const RegionMesh& mesh, const SeedsView& seeds) {
  ReferenceDiagram diagram = start(seeds);
  std::vector<std::uint32_t> all(seeds.size());
  std::iota(all.begin(), all.end(), 0u);
  for (std::uint32_t i = 0; i < seeds.size(); ++i) cut_seed(diagram, mesh, seeds, i, all);
  return diagram;
}

ReferenceDiagram cut_by_candidates(const RegionMesh& mesh, const SeedsView& seeds,
                                   std::span<const std::uint64_t> offset,
                                   std::span<const std::uint32_t> candidates,
                                   std::span<const std::uint8_t> skip) {
  ReferenceDiagram diagram = start(seeds);
  for (std::uint32_t i = 0; i < seeds.size(); ++i) {
    if (skip[i] && diagram.status[i] == SeedStatus::ok) diagram.status[i] = SeedStatus::hidden;
    if (skip[i]) continue;
    cut_seed(diagram, mesh, seeds, i, candidates.subspan(offset[i], offset[i + 1] - offset[i]));
  }
  return diagram;
}

Real power(const SeedsView& seeds, std::size_t i, std::span<const double> x) {
  const Vec d = Vec{x[0], x[1], seeds.dimension == 3 ? x[2] : 0.0} - position(seeds, i);
  return dot(d, d) - weight(seeds, i);
}

std::pair<std::size_t, Real> owner(const SeedsView& seeds, std::span<const double> x) {
  std::size_t best = 0;
  Real least = std::numeric_limits<Real>::infinity(), second = least;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const Real p = power(seeds, i, x);
    if (p < least) {
      second = least;
      least = p;
      best = i;
    } else {
      second = std::min(second, p);
    }
  }
  return {best, second - least};
}

RegionMesh box_mesh(int dimension, const Box& box) {
  RegionMesh mesh;
  mesh.kind = dimension == 2 ? DomainKind::polygon : DomainKind::volume;
  mesh.dimension = mesh.cell_dimension = dimension;
  mesh.shape = dimension == 2 ? RegionShape::polygon : RegionShape::box;
  mesh.low = box.low;
  mesh.high = box.high;
  mesh.measure = 1;
  for (int k = 0; k < dimension; ++k)
    mesh.measure *= box.high[static_cast<std::size_t>(k)] - box.low[static_cast<std::size_t>(k)];
  const std::uint32_t corners = dimension == 2 ? 4 : 8, facets = dimension == 2 ? 4 : 6;
  for (std::uint32_t c = 0; c < corners; ++c) {
    // Corners are in order around the square; in space the bits of c are x, y, z.
    const std::uint32_t bits = dimension == 2 ? (c ^ (c >> 1)) : c;
    for (int k = 0; k < dimension; ++k)
      mesh.vertices.push_back(((bits >> k) & 1) ? box.high[static_cast<std::size_t>(k)]
                                                : box.low[static_cast<std::size_t>(k)]);
    mesh.region_vertex.push_back(c);
  }
  for (std::uint32_t f = 0; f < facets; ++f) mesh.facet.push_back({Border::Kind::boundary, f});
  mesh.region_offset = {0, corners};
  mesh.facet_offset = {0, facets};
  mesh.source = {0};
  mesh.boundary_count = facets;
  return mesh;
}

}  // namespace powercell::test
