#include "lib/applications/remeshing/dual.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "lib/applications/remeshing/cell_parts.hpp"
#include "lib/applications/remeshing/mesh_check.hpp"
#include "lib/applications/remeshing/triangle.hpp"

namespace powercell::remeshing {
namespace {

using Corners = std::array<std::uint32_t, 3>;

/// The points where three cells meet, as triangles of seeds. Each of the three cells has the point as a
/// corner between two walls; in cell i the order around it is (i, seed behind the edge that ends there, seed
/// behind the edge that starts there).
/// \param inconsistent  output: seeds of cells that disagree about a corner
std::vector<Corners> triple_points(const LocalDiagram& diagram, std::vector<std::uint32_t>& inconsistent) {
  std::vector<Corners> triangles;
  std::vector<Corners> seen;  // in one triangle of the surface
  for (std::uint32_t t = 0; t < diagram.surface().size(); ++t) {
    seen.clear();
    for (const std::uint32_t p : diagram.pieces_in(t)) {
      const Piece& piece = diagram.piece(p);
      for (std::size_t v = 0; v < piece.ring.size(); ++v) {
        const int in = piece.ring[v == 0 ? piece.ring.size() - 1 : v - 1].edge, out = piece.ring[v].edge;
        if (in < 0 || out < 0) continue;
        Corners row{piece.seed, static_cast<std::uint32_t>(in), static_cast<std::uint32_t>(out)};
        std::rotate(row.begin(), std::min_element(row.begin(), row.end()), row.end());
        seen.push_back(row);
      }
    }
    std::sort(seen.begin(), seen.end());
    for (std::size_t k = 0; k < seen.size();) {
      std::size_t end = k + 1;
      while (end < seen.size() && seen[end] == seen[k]) ++end;
      if (end - k == 3)
        triangles.push_back(seen[k]);
      else  // because of rounding
        inconsistent.insert(inconsistent.end(), seen[k].begin(), seen[k].end());
      k = end;
    }
  }
  return triangles;
}

/// Reflects a place on one sheet of the surface to another sheet, so that cells of seeds at both places meet
/// half way and neither extends to the other sheet. (The nearest point would do so for parallel sheets only.)
Vec opposite(const Surface& surface, const Place& place, std::uint32_t triangle) {
  const Vec normal = surface.normal(triangle), across = surface.normal(place.triangle) - normal;
  const double slope = dot(across, normal);
  if (slope > -0.1) return place.at;  // the sheets nearly coincide
  return place.at - across * (dot(place.at - surface.corner(triangle, 0), normal) / slope);
}

/// The place in a part of a cell nearest to the reflection of its seed.
Place place_opposite(const Sampling& sampling, const CellParts& parts, std::uint32_t part) {
  const LocalDiagram& diagram = sampling.diagram();
  const std::uint32_t seed = parts.seed[part];
  Place nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t p : diagram.pieces(seed)) {
    if (parts.part[p] != part) continue;
    const Piece& piece = diagram.piece(p);
    const Vec to = opposite(diagram.surface(), sampling.hold(seed).place, piece.triangle);
    for (std::size_t v = 1; v + 1 < piece.ring.size(); ++v) {
      const Vec at = nearest_in_triangle(to, piece.ring[0].at, piece.ring[v].at, piece.ring[v + 1].at);
      if (norm2(at - to) >= least) continue;
      least = norm2(at - to);
      nearest = {piece.triangle, at};
    }
  }
  return nearest;
}

/// Finds pairs of cells that share several walls.
void find_double_walls(const MeshCheck& check, Defects& defects) {
  for (std::size_t k = 1; k < check.edges.size(); ++k)
    if (check.edges[k] == check.edges[k - 1]) {
      const auto from = static_cast<std::uint32_t>(check.edges[k] >> 32),
                 to = static_cast<std::uint32_t>(check.edges[k]);
      defects.twice.emplace_back(std::minmax(from, to));
    }
}

/// Finds parts of cells without their seed, and cells that are not discs.
void find_part_defects(const Sampling& sampling, Defects& defects) {
  const LocalDiagram& diagram = sampling.diagram();
  const CellParts parts = cell_parts(diagram);
  std::vector<std::uint32_t> own(diagram.size(), nothing);
  for (std::uint32_t i = 0; i < diagram.size(); ++i)
    for (const std::uint32_t p : diagram.pieces(i))
      if (diagram.piece(p).triangle == sampling.hold(i).place.triangle) own[i] = parts.part[p];
  std::vector<bool> seen(parts.seed.size(), false);
  for (std::uint32_t i = 0; i < diagram.size(); ++i) {
    if (!diagram.seed(i).alive) continue;
    if (own[i] == nothing) defects.outside.push_back(i);
    for (const std::uint32_t p : diagram.pieces(i)) {
      const std::uint32_t part = parts.part[p];
      if (seen[part]) continue;
      seen[part] = true;
      if (part == own[i]) {
        if (parts.euler[part] != 1) defects.not_discs.push_back(i);
        continue;
      }
      defects.fragments.push_back(place_opposite(sampling, parts, part));
    }
  }
}

/// The position of an edge of the surface on a curve.
struct OnCurve {
  std::uint32_t curve;
  std::size_t edge;
};

std::unordered_map<std::uint64_t, OnCurve> curve_edges(const Sampling& sampling) {
  std::unordered_map<std::uint64_t, OnCurve> result;
  for (std::uint32_t c = 0; c < sampling.curve_count(); ++c) {
    const std::vector<std::uint32_t>& v = sampling.curve(c).vertex;
    for (std::size_t k = 0; k + 1 < v.size(); ++k)
      result[edge_key(std::min(v[k], v[k + 1]), std::max(v[k], v[k + 1]))] = {c, k};
  }
  return result;
}

/// The length along curve c at the seed with this rank.
double along_of(const Sampling& sampling, std::uint32_t c, std::size_t rank) {
  const auto& seeds = sampling.on_curve(c);
  if (rank == 0 && !sampling.curve(c).closed) return 0;
  if (rank + 1 == seeds.size()) return sampling.curve(c).length();
  return sampling.hold(seeds[rank]).along;
}

/// The rank of the seed before the chord that spans the length s.
std::size_t rank_at(const Sampling& sampling, std::uint32_t c, double s) {
  std::size_t rank = 0;
  while (rank + 2 < sampling.on_curve(c).size() && along_of(sampling, c, rank + 1) <= s) ++rank;
  return rank;
}

/// Finds chords where the curve between their seeds passes through cells of other seeds.
void find_intruders(const Sampling& sampling, Defects& defects) {
  const LocalDiagram& diagram = sampling.diagram();
  const Surface& surface = diagram.surface();
  const auto edges = curve_edges(sampling);
  for (std::uint32_t t = 0; t < surface.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      if (!surface.kept[t][k]) continue;
      const std::uint32_t a = surface.triangle[t][k], b = surface.triangle[t][(k + 1) % 3];
      const OnCurve on = edges.at(edge_key(std::min(a, b), std::max(a, b)));
      const Curve& curve = sampling.curve(on.curve);
      for (const std::uint32_t p : diagram.pieces_in(t)) {
        const Piece& piece = diagram.piece(p);
        for (std::size_t v = 0; v < piece.ring.size(); ++v) {
          if (piece.ring[v].edge != ~static_cast<int>(k)) continue;
          const Vec middle = (piece.ring[v].at + piece.ring[(v + 1) % piece.ring.size()].at) * 0.5;
          const double s = curve.along[on.edge] + norm(middle - surface.vertex[curve.vertex[on.edge]]);
          const std::size_t rank = rank_at(sampling, on.curve, s);
          const auto& seeds = sampling.on_curve(on.curve);
          if (piece.seed != seeds[rank] && piece.seed != seeds[rank + 1])
            defects.chords.emplace_back(on.curve, rank);
        }
      }
    }
}

/// Finds chords that are not edges of the dual, and boundary edges of the dual that are not chords.
void find_edge_defects(const Sampling& sampling, const MeshCheck& check, Defects& defects) {
  std::vector<std::uint64_t> chords;
  for (std::uint32_t c = 0; c < sampling.curve_count(); ++c) {
    const auto& seeds = sampling.on_curve(c);
    for (std::size_t k = 0; k + 1 < seeds.size(); ++k) {
      const std::uint32_t a = seeds[k], b = seeds[k + 1];
      chords.insert(chords.end(), {edge_key(a, b), edge_key(b, a)});
      if (!check.has_edge(a, b) && !check.has_edge(b, a)) defects.chords.emplace_back(c, k);
    }
  }
  std::sort(chords.begin(), chords.end());
  for (const auto& [a, b] : check.boundary_edges)
    if (!std::binary_search(chords.begin(), chords.end(), edge_key(a, b)))
      defects.seeds.insert(defects.seeds.end(), {a, b});
}

template <class T>
void keep_distinct(std::vector<T>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

DualMesh dual_of(const Sampling& sampling, Defects& defects, Progress progress) {
  DualMesh dual;
  const LocalDiagram& diagram = sampling.diagram();
  dual.triangle = triple_points(diagram, defects.seeds);
  progress.at(0);
  find_part_defects(sampling, defects);
  progress.at(0);
  find_intruders(sampling, defects);
  progress.at(0);
  const MeshCheck check = check_mesh(dual.triangle, diagram.size());
  defects.seeds.insert(defects.seeds.end(), check.not_manifold.begin(), check.not_manifold.end());
  progress.at(0);
  find_double_walls(check, defects);
  find_edge_defects(sampling, check, defects);
  for (std::uint32_t i = 0; i < diagram.size(); ++i)
    if (diagram.seed(i).alive && !check.used[i]) defects.seeds.push_back(i);
  keep_distinct(defects.seeds);
  keep_distinct(defects.twice);
  keep_distinct(defects.chords);
  return dual;
}

}  // namespace powercell::remeshing
