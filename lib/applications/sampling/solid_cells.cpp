#include "lib/applications/sampling/solid_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "lib/applications/sampling/apart.hpp"
#include "lib/applications/sampling/nearest.hpp"
#include "lib/base/disjoint_sets.hpp"

namespace powercell {
namespace {

using Vec = Vector3<double>;
using Faces = std::vector<std::uint64_t>;

/// The angle at which a triangle is seen from 0, positive from inside. A. van Oosterom, J. Strackee: The
/// solid angle of a plane triangle, IEEE Trans. Biomed. Eng. 30, 1983.
double solid_angle(const Vec& a, const Vec& b, const Vec& c) {
  const double la = norm(a), lb = norm(b), lc = norm(c);
  return 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

class SolidCell {
 public:
  SolidCell(const JoinedCells& cells, std::size_t cell) : cells_(cells), cell_(cell) {}

  Faces faces() const {
    Faces all(cells_.face_offset[cell_ + 1] - cells_.face_offset[cell_]);
    std::iota(all.begin(), all.end(), cells_.face_offset[cell_]);
    return all;
  }

  std::vector<Vec> corners(std::uint64_t face) const {
    std::vector<Vec> result;
    for (std::uint64_t k = cells_.loop_offset[face]; k < cells_.loop_offset[face + 1]; ++k) {
      const double* x = &cells_.vertices[3 * (cells_.vertex_offset[cell_] + cells_.loop[k])];
      result.push_back({x[0], x[1], x[2]});
    }
    return result;
  }

  /// \param act  gets the corners of the triangles of the faces
  template <class Act>
  void for_each_triangle(const Faces& faces, const Act& act) const {
    for (const std::uint64_t face : faces) {
      const std::vector<Vec> at = corners(face);
      for (std::size_t k = 2; k < at.size(); ++k) act(at[0], at[k - 1], at[k]);
    }
  }

  bool contains(const Faces& closed, const Vec& x) const {
    double seen = 0;
    for_each_triangle(
        closed, [&](const Vec& a, const Vec& b, const Vec& c) { seen += solid_angle(a - x, b - x, c - x); });
    return seen > 2 * std::numbers::pi;
  }

  Vec nearest(const Faces& closed, const Vec& x) const {
    if (contains(closed, x)) return x;
    Vec best{};
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint64_t face : closed) {
      const Vec point = nearest_in_polygon(corners(face), x);
      if (const double d = norm(point - x); d < least) {
        least = d;
        best = point;
      }
    }
    return best;
  }

  /// Volume, negative of the boundary of a cavity, and first moment.
  Moment moment(const Faces& closed) const {
    const Vec origin = corners(closed.front()).front();
    Moment sum;
    for_each_triangle(closed, [&](const Vec& a, const Vec& b, const Vec& c) {
      sum.add(dot(a - origin, cross(b - origin, c - origin)) / 6, 0.25 * (origin + a + b + c));
    });
    return sum;
  }

  /// The faces by closed surfaces: faces of one share edges.
  std::vector<Faces> shells() const {
    struct Edge {
      std::uint32_t low, high, face;
      auto operator<=>(const Edge&) const = default;
    };
    const std::uint64_t first = cells_.face_offset[cell_];
    const auto count = static_cast<std::uint32_t>(cells_.face_offset[cell_ + 1] - first);
    std::vector<Edge> edges;
    for (std::uint32_t f = 0; f < count; ++f) {
      const std::uint64_t begin = cells_.loop_offset[first + f], end = cells_.loop_offset[first + f + 1];
      for (std::uint64_t k = begin; k < end; ++k) {
        const auto [a, b] = std::minmax(cells_.loop[k], cells_.loop[k + 1 < end ? k + 1 : begin]);
        edges.push_back({a, b, f});
      }
    }
    std::ranges::sort(edges);
    DisjointSets sets(count);
    for (std::size_t k = 1; k < edges.size(); ++k)
      if (edges[k].low == edges[k - 1].low && edges[k].high == edges[k - 1].high)
        sets.unite(edges[k].face, edges[k - 1].face);
    std::vector<Faces> result(count);
    for (std::uint32_t f = 0; f < count; ++f) result[sets.root(f)].push_back(first + f);
    std::erase_if(result, [](const Faces& faces) { return faces.empty(); });
    return result;
  }

 private:
  const JoinedCells& cells_;
  std::size_t cell_;
};

/// A part of a cell: its outer surface and those of its cavities.
struct Part {
  Faces faces;
  Moment moment;
};

std::vector<Part> parts_of(const SolidCell& cell) {
  std::vector<Part> parts, cavities;
  for (Faces& shell : cell.shells()) {
    const Moment moment = cell.moment(shell);
    (moment.measure > 0 ? parts : cavities).push_back({std::move(shell), moment});
  }
  for (const Part& cavity : cavities) {
    const Vec at = cell.corners(cavity.faces.front()).front();
    const auto around =
        std::ranges::find_if(parts, [&](const Part& part) { return cell.contains(part.faces, at); });
    if (around == parts.end()) continue;  // without extent
    around->faces.insert(around->faces.end(), cavity.faces.begin(), cavity.faces.end());
    around->moment.add(cavity.moment);
  }
  return parts;
}

}  // namespace

Vec nearest_in_cell(const JoinedCells& cells, std::size_t cell, const Vec& x) {
  const SolidCell view(cells, cell);
  return view.nearest(view.faces(), x);
}

PartsApart parts_apart(const JoinedCells& cells, std::span<const double> positions) {
  const std::size_t n = positions.size() / 3;
  std::vector<std::vector<Part>> parts;
  double whole = 0;
  for (std::size_t i = 0; i < n; ++i) {
    parts.push_back(parts_of({cells, i}));
    for (const Part& part : parts.back()) whole += part.moment.measure;
  }
  PartsTally tally(whole, n);
  for (std::size_t i = 0; i < n; ++i) {
    const SolidCell cell(cells, i);
    std::vector<Moment> moments;
    for (const Part& part : parts[i]) moments.push_back(part.moment);
    const Vec point{positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
    tally.add_cell(moments, point, [&](std::size_t part, const Vec& x) {
      return norm(cell.nearest(parts[i][part].faces, x) - x);
    });
  }
  return tally.result();
}

}  // namespace powercell
