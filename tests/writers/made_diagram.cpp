#include "tests/writers/made_diagram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "lib/domain/region_mesh.hpp"
#include "tests/writers/clip_pieces.hpp"
#include "tests/writers/join_pieces.hpp"

namespace powercell::test {
namespace {

Point mesh_point(const RegionMesh& mesh, std::uint32_t v) {
  const auto d = static_cast<std::size_t>(mesh.dimension);
  return {mesh.vertices[v * d], mesh.vertices[v * d + 1], d == 3 ? mesh.vertices[v * d + 2] : 0.0};
}

Piece region_piece(const RegionMesh& mesh, std::size_t region) {
  Piece piece;
  for (std::uint32_t k = mesh.region_offset[region]; k < mesh.region_offset[region + 1]; ++k) {
    piece.vertices.push_back(mesh_point(mesh, mesh.region_vertex[k]));
  }
  for (std::uint32_t k = mesh.facet_offset[region]; k < mesh.facet_offset[region + 1]; ++k) {
    piece.border.push_back(mesh.facet[k]);
  }
  // Facet k of a tetrahedron is opposite vertex k.
  if (mesh.shape == RegionShape::tetrahedron) piece.loops = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  return piece;
}

struct Maker {
  MadeDiagram& made;
  std::size_t d, n;

  Point seed(std::size_t i) const {
    return {made.positions[i * d], made.positions[i * d + 1], d == 3 ? made.positions[i * d + 2] : 0.0};
  }
  double power(std::size_t i, const Point& x) const {
    return dot(x - seed(i), x - seed(i)) - made.weights[i];
  }
  bool is_duplicate(std::size_t i) const {
    for (std::size_t j = 0; j < n; ++j) {
      const bool wins = made.weights[j] > made.weights[i] || (made.weights[j] == made.weights[i] && j < i);
      if (j != i && seed(j) == seed(i) && wins) return true;
    }
    return false;
  }
  Piece cut(Piece piece, std::size_t i, std::size_t j) const {
    if (i == j || seed(i) == seed(j)) return piece;
    const Point normal = (seed(j) - seed(i)) * 2;
    const double offset = dot(seed(j), seed(j)) - made.weights[j] - dot(seed(i), seed(i)) + made.weights[i];
    return clip(piece, normal, offset, {Border::Kind::wall, static_cast<std::uint32_t>(j)});
  }
  // The seeds that own the corners and the middle of the region come first: they empty most pieces at once.
  Piece cell_piece(const Piece& region, std::size_t i, const std::vector<std::size_t>& owners) const {
    Piece piece = region;
    for (std::size_t k = 0; k < owners.size() && !piece.empty(); ++k) piece = cut(piece, i, owners[k]);
    for (std::size_t j = 0; j < n && !piece.empty(); ++j) {
      const bool done = std::find(owners.begin(), owners.end(), j) != owners.end();
      if (!done && made.measures.status[j] != SeedStatus::duplicate) piece = cut(piece, i, j);
    }
    return piece;
  }
  std::vector<std::size_t> owners(const Piece& region) const {
    std::vector<std::size_t> result;
    for (const Point& x : region.vertices) {
      std::size_t best = 0;
      for (std::size_t j = 1; j < n; ++j) best = power(j, x) < power(best, x) ? j : best;
      if (std::find(result.begin(), result.end(), best) == result.end()) result.push_back(best);
    }
    return result;
  }
};

double determinant(const std::vector<Point>& s) {
  if (s.size() == 4) return dot(s[1] - s[0], cross(s[2] - s[0], s[3] - s[0])) / 6;
  return area(s);
}

void measure_piece(MadeDiagram& made, std::size_t i, const Point& p, const Piece& piece) {
  const auto d = static_cast<std::size_t>(made.domain.dimension());
  for (const auto& simplex : simplices(piece)) {
    const double volume = determinant(simplex);
    const auto corners = static_cast<double>(simplex.size());
    Point sum{};
    double squares = 0;
    for (const Point& v : simplex) {
      sum = sum + (v - p);
      squares += dot(v - p, v - p);
    }
    made.measures.mass[i] += volume;
    made.measures.second_moment[i] += volume / (corners * (corners + 1)) * (squares + dot(sum, sum));
    for (std::size_t k = 0; k < d; ++k)
      made.measures.centroid[i * d + k] += volume * (p[k] + sum[k] / corners);
  }
}

void append_piece(Cells& cells, std::size_t region, const Piece& piece) {
  cells.region.push_back(static_cast<std::uint32_t>(region));
  for (const Point& v : piece.vertices) {
    cells.vertices.insert(cells.vertices.end(), v.begin(), v.begin() + cells.dimension);
  }
  cells.vertex_offset.push_back(cells.vertices.size() / static_cast<std::size_t>(cells.dimension));
  cells.border.insert(cells.border.end(), piece.border.begin(), piece.border.end());
  cells.face_offset.push_back(cells.border.size());
  for (const auto& loop : piece.loops) {
    cells.loop.insert(cells.loop.end(), loop.begin(), loop.end());
    cells.loop_offset.push_back(cells.loop.size());
  }
}

void add_walls(std::map<std::uint32_t, double>& walls, const Piece& piece) {
  for (std::size_t f = 0; f < piece.border.size(); ++f) {
    if (piece.border[f].kind != Border::Kind::wall) continue;
    std::vector<Point> loop;
    if (piece.loops.empty()) {
      const Point along = piece.vertices[(f + 1) % piece.vertices.size()] - piece.vertices[f];
      walls[piece.border[f].index] += std::sqrt(dot(along, along));
      continue;
    }
    for (const std::uint32_t v : piece.loops[f]) loop.push_back(piece.vertices[v]);
    walls[piece.border[f].index] += area(loop);
  }
}

void start(MadeDiagram& made, std::size_t n) {
  const int d = made.domain.dimension();
  made.measures.dimension = made.cells.dimension = d;
  made.cells.cell_dimension = made.domain.cell_dimension();
  made.measures.mass.assign(n, 0);
  made.measures.second_moment.assign(n, 0);
  made.measures.centroid.assign(n * static_cast<std::size_t>(d), 0);
  made.measures.status.assign(n, SeedStatus::ok);
  made.measures.domain_measure = made.domain.measure();
  made.cells.cell_offset = made.cells.vertex_offset = made.cells.face_offset = made.adjacency.offset = {0};
  if (made.cells.cell_dimension == 3) made.cells.loop_offset = {0};
}

void finish_cell(MadeDiagram& made, std::size_t i, const std::map<std::uint32_t, double>& walls) {
  const auto d = static_cast<std::size_t>(made.domain.dimension());
  const double mass = made.measures.mass[i];
  for (std::size_t k = 0; k < d; ++k) {
    double& c = made.measures.centroid[i * d + k];
    c = mass > 0 ? c / mass : std::numeric_limits<double>::quiet_NaN();
  }
  if (mass == 0 && made.measures.status[i] == SeedStatus::ok) made.measures.status[i] = SeedStatus::hidden;
  made.cells.cell_offset.push_back(made.cells.region.size());
  for (const auto& [j, wall] : walls) {
    made.adjacency.neighbor.push_back(j);
    made.adjacency.wall.push_back(wall);
  }
  made.adjacency.offset.push_back(made.adjacency.neighbor.size());
}

}  // namespace

MadeDiagram make_diagram(const Domain& domain, std::vector<double> positions, std::vector<double> weights) {
  MadeDiagram made{domain, std::move(positions), std::move(weights), {}, {}, {}, {}};
  const std::size_t n = made.weights.size();
  start(made, n);
  const Maker maker{made, static_cast<std::size_t>(domain.dimension()), n};
  for (std::size_t i = 0; i < n; ++i) {
    if (maker.is_duplicate(i)) made.measures.status[i] = SeedStatus::duplicate;
  }
  std::vector<Piece> regions;
  std::vector<std::vector<std::size_t>> owners;
  for (std::size_t r = 0; n > 0 && r < domain.mesh().region_count(); ++r) {
    regions.push_back(region_piece(domain.mesh(), r));
    owners.push_back(maker.owners(regions.back()));
  }
  for (std::size_t i = 0; i < n; ++i) {
    std::map<std::uint32_t, double> walls;
    for (std::size_t r = 0; r < regions.size() && made.measures.status[i] == SeedStatus::ok; ++r) {
      const Piece piece = maker.cell_piece(regions[r], i, owners[r]);
      if (piece.empty()) continue;
      append_piece(made.cells, r, piece);
      measure_piece(made, i, maker.seed(i), piece);
      add_walls(walls, piece);
    }
    finish_cell(made, i, walls);
  }
  made.joined = join_pieces(made.cells);
  return made;
}

}  // namespace powercell::test
