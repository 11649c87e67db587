#include "tests/writers/clip_pieces.hpp"

#include <cmath>
#include <map>

namespace powercell::test {

Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Point operator*(const Point& a, double s) {
  return {a[0] * s, a[1] * s, a[2] * s};
}
double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

namespace {

Piece clip_polygon(const Piece& piece, const std::vector<double>& side, Border border) {
  Piece kept;
  const std::size_t n = piece.vertices.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n;
    const bool in = side[k] <= 0, next_in = side[next] <= 0;
    if (in) {
      kept.vertices.push_back(piece.vertices[k]);
      kept.border.push_back(piece.border[k]);
    }
    if (in == next_in) continue;
    const double t = side[k] / (side[k] - side[next]);
    kept.vertices.push_back(piece.vertices[k] + (piece.vertices[next] - piece.vertices[k]) * t);
    kept.border.push_back(in ? border : piece.border[k]);
  }
  return kept.vertices.size() < 3 ? Piece{} : kept;
}

// Vertices kept or created by a cut of a polyhedron.
struct Cut {
  const Piece& piece;
  const std::vector<double>& side;
  Piece kept;
  std::map<std::uint32_t, std::uint32_t> old;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> made;

  std::uint32_t keep(std::uint32_t v) {
    const auto [at, added] = old.try_emplace(v, static_cast<std::uint32_t>(kept.vertices.size()));
    if (added) kept.vertices.push_back(piece.vertices[v]);
    return at->second;
  }
  std::uint32_t cross_edge(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto [at, added] = made.try_emplace({a, b}, static_cast<std::uint32_t>(kept.vertices.size()));
    const double t = side[a] / (side[a] - side[b]);
    if (added) kept.vertices.push_back(piece.vertices[a] + (piece.vertices[b] - piece.vertices[a]) * t);
    return at->second;
  }
};

Piece clip_polyhedron(const Piece& piece, const std::vector<double>& side, Border border) {
  Cut cut{piece, side, {}, {}, {}};
  std::map<std::uint32_t, std::uint32_t> rim;  // along the cut, in the order of the new face
  for (std::size_t f = 0; f < piece.loops.size(); ++f) {
    const auto& loop = piece.loops[f];
    std::vector<std::uint32_t> kept;
    std::uint32_t leaves = 0, enters = 0;
    bool crossed = false;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::uint32_t a = loop[k], b = loop[(k + 1) % loop.size()];
      if (side[a] <= 0) kept.push_back(cut.keep(a));
      if ((side[a] <= 0) == (side[b] <= 0)) continue;
      crossed = true;
      const std::uint32_t v = cut.cross_edge(a, b);
      kept.push_back(v);
      (side[a] <= 0 ? leaves : enters) = v;
    }
    if (kept.size() < 3) continue;
    if (crossed) rim[enters] = leaves;
    cut.kept.loops.push_back(kept);
    cut.kept.border.push_back(piece.border[f]);
  }
  if (cut.kept.loops.size() < 3) return {};
  if (!rim.empty()) {
    std::vector<std::uint32_t> face;
    std::uint32_t v = rim.begin()->first;
    do {
      face.push_back(v);
      v = rim.at(v);
    } while (v != rim.begin()->first);
    cut.kept.loops.push_back(face);
    cut.kept.border.push_back(border);
  }
  return cut.kept;
}

}  // namespace

Piece clip(const Piece& piece, const Point& normal, double offset, Border border) {
  std::vector<double> side;
  bool all_in = true, all_out = true;
  for (const Point& v : piece.vertices) {
    side.push_back(dot(normal, v) - offset);
    (side.back() <= 0 ? all_out : all_in) = false;
  }
  if (all_out) return {};
  if (all_in) return piece;
  return piece.loops.empty() ? clip_polygon(piece, side, border) : clip_polyhedron(piece, side, border);
}

std::vector<std::vector<Point>> simplices(const Piece& piece) {
  std::vector<std::vector<Point>> result;
  const auto& v = piece.vertices;
  for (std::size_t k = 1; piece.loops.empty() && k + 1 < v.size(); ++k)
    result.push_back({v[0], v[k], v[k + 1]});
  for (const auto& loop : piece.loops) {
    for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
      result.push_back({v[0], v[loop[0]], v[loop[k]], v[loop[k + 1]]});
    }
  }
  return result;
}

double area(const std::vector<Point>& loop) {
  Point sum{};
  for (std::size_t k = 1; k + 1 < loop.size(); ++k)
    sum = sum + cross(loop[k] - loop[0], loop[k + 1] - loop[0]);
  return 0.5 * std::sqrt(dot(sum, sum));
}

}  // namespace powercell::test
