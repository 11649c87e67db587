#include <algorithm>
#include <optional>

#include "lib/applications/remeshing/nearest.hpp"
#include "lib/applications/remeshing/relax.hpp"
#include "lib/applications/remeshing/star.hpp"
#include "lib/applications/remeshing/triangle.hpp"

namespace powercell::remeshing {
namespace {

constexpr double share = 0.01;       // of the triangles, that a pass works on
constexpr double negligible = 1e-4;  // distance from the surface in units of h

std::vector<std::array<Vec, 3>> corners_of(const Surface& surface) {
  std::vector<std::array<Vec, 3>> corners(surface.size());
  for (std::uint32_t t = 0; t < surface.size(); ++t)
    corners[t] = {surface.corner(t, 0), surface.corner(t, 1), surface.corner(t, 2)};
  return corners;
}

/// At most 1 for a triangle of sufficient shape.
double shape_cost(Vec a, Vec b, Vec c) {
  return misshape(a, b, c, 0.74);
}

class Fit {
 public:
  Fit(WorkMesh& mesh, const Surface& surface, const Sizing& sizing, Progress& progress)
      : mesh_(mesh), surface_(surface), sizing_(sizing), progress_(progress), nearest_(corners_of(surface)) {}

  /// \return whether anything changed
  bool pass() {
    bool any = false;
    for (const std::uint32_t v : far_vertices()) {
      progress_.tick();
      any |= flip_around(v);
      if (mesh_.vertex(v).kind == Hold::Kind::free) any |= move(v);
    }
    return any;
  }

 private:
  /// The largest squared distance from the surface of the centroid and the midpoints of the edges.
  double distance2(Vec a, Vec b, Vec c) const {
    return std::max({nearest_.distance2((a + b + c) * (1.0 / 3)), nearest_.distance2((a + b) * 0.5),
                     nearest_.distance2((b + c) * 0.5), nearest_.distance2((c + a) * 0.5)});
  }

  /// The corners of the farthest triangles, ascending.
  std::vector<std::uint32_t> far_vertices() const {
    const std::vector<WorkMesh::Corners>& rows = mesh_.triangles();
    std::vector<double> distance(rows.size());
    for (std::size_t t = 0; t < rows.size(); ++t) {
      if (rows[t][0] == rows[t][1]) continue;
      progress_.tick();
      distance[t] = distance2(mesh_.at(rows[t][0]), mesh_.at(rows[t][1]), mesh_.at(rows[t][2]));
    }
    std::vector<double> sorted = distance;
    const auto far =
        sorted.begin() + static_cast<std::ptrdiff_t>((1 - share) * static_cast<double>(rows.size()));
    std::nth_element(sorted.begin(), far, sorted.end());
    std::vector<std::uint32_t> vertices;
    for (std::size_t t = 0; t < rows.size(); ++t)
      if (distance[t] >= *far) vertices.insert(vertices.end(), rows[t].begin(), rows[t].end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }

  bool move(std::uint32_t v) {
    const double h = mesh_.vertex(v).h;
    const double shape = std::max(1.0, cost_around(mesh_, surface_, v, mesh_.vertex(v).place, shape_cost));
    const auto cost = [&](Vec a, Vec b, Vec c) {
      return shape_cost(a, b, c) > shape ? worst : distance2(a, b, c);
    };
    const auto place_at = [&](const Vec& to) { return project(surface_, mesh_.vertex(v).place, to); };
    const double before = cost_around(mesh_, surface_, v, mesh_.vertex(v).place, cost);
    if (!(before > negligible * negligible * h * h) || before == worst) return false;
    for (const double step : {0.16, 0.08, 0.04}) {
      const auto best = best_around(mesh_, surface_, v, step * h, 0.97 * before, [&](const Place& to) {
        return cost_around(mesh_, surface_, v, place_at(to.at), cost);
      });
      if (!best) continue;
      const Place place = place_at(*best);
      mesh_.move(v, place, sizing_.at(surface_, place));
      return true;
    }
    return false;
  }

  bool flip_around(std::uint32_t v) {
    bool any = false;
    for (const std::uint32_t u : mesh_.neighbors(v)) {
      const auto e = mesh_.edge(v, u);
      if (!e || !mesh_.can_flip(*e) || !is_nearer_flipped(*e)) continue;
      mesh_.flip(*e);
      any = true;
    }
    return any;
  }

  bool is_nearer_flipped(const WorkMesh::Edge& e) const {
    constexpr double least_cosine = 0.8;  // between the normals of the two triangles
    const Vec a = mesh_.at(e.a), b = mesh_.at(e.b), c = mesh_.at(e.c), d = mesh_.at(e.d);
    const double shape = std::max({1.0, shape_cost(a, b, c), shape_cost(b, a, d)});
    if (std::max(shape_cost(a, d, c), shape_cost(d, b, c)) > shape) return false;
    const Vec left = unit(normal_of(a, d, c)), right = unit(normal_of(d, b, c));
    const Vec old = unit(unit(normal_of(a, b, c)) + unit(normal_of(b, a, d)));
    if (dot(left, right) < least_cosine || dot(left, old) < least_cosine || dot(right, old) < least_cosine)
      return false;
    if (flips_inwards(mesh_, surface_, e)) return false;
    const double before = std::max(distance2(a, b, c), distance2(b, a, d));
    return before > negligible * negligible * norm2(a - b) &&
           std::max(distance2(a, d, c), distance2(d, b, c)) < 0.9 * before;
  }

  WorkMesh& mesh_;
  const Surface& surface_;
  const Sizing& sizing_;
  Progress& progress_;
  NearestPoint nearest_;
};

}  // namespace

void fit(WorkMesh& mesh, const Surface& surface, const Sizing& sizing, int passes, Progress progress) {
  progress.at(0);
  Fit fit(mesh, surface, sizing, progress);
  for (int pass = 0; pass < passes; ++pass) {
    progress.at(static_cast<double>(pass) / passes);
    if (!fit.pass()) return;
  }
}

}  // namespace powercell::remeshing
