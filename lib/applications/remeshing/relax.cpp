#include "lib/applications/remeshing/relax.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "lib/applications/remeshing/star.hpp"
#include "lib/applications/remeshing/triangle.hpp"

namespace powercell::remeshing {
namespace {

using Corners = WorkMesh::Corners;

using Cost = double (*)(Vec, Vec, Vec);  ///< cost of a triangle by its corners, lower is better

/// Above 1 for a triangle that mend_worst() works on.
double shape_cost(Vec a, Vec b, Vec c) {
  return misshape(a, b, c, 0.7);
}

/// The larger cost of the two triangles of an edge after a flip; `worst` if the flip would fold the surface.
double cost_flipped(const WorkMesh& mesh, const Surface& surface, const WorkMesh::Edge& e, Cost cost) {
  const Vec a = mesh.at(e.a), b = mesh.at(e.b), c = mesh.at(e.c), d = mesh.at(e.d);
  const Vec left = unit(normal_of(a, d, c)), right = unit(normal_of(d, b, c));
  const Vec old_left = unit(normal_of(a, b, c)), old_right = unit(normal_of(b, a, d));
  const double least_bend = std::min(0.8, dot(old_left, old_right) - 0.1);
  if (dot(left, right) < least_bend) return worst;
  const Vec mean = unit(old_left + old_right);
  if (dot(left, mean) < 0.6 || dot(right, mean) < 0.6) return worst;
  if (flips_inwards(mesh, surface, e)) return worst;
  return std::max(cost(a, d, c), cost(d, b, c));
}

double cost_of(const WorkMesh& mesh, const WorkMesh::Edge& e, Cost cost) {
  const Vec a = mesh.at(e.a), b = mesh.at(e.b), c = mesh.at(e.c), d = mesh.at(e.d);
  return std::max(cost(a, b, c), cost(b, a, d));
}

/// The degree that makes a vertex regular.
int regular(const WorkMesh& mesh, std::uint32_t v) {
  return mesh.vertex(v).boundary ? 4 : 6;
}

/// The decrease of the sum of squared excess degrees by a flip.
int degree_gain(const WorkMesh& mesh, const WorkMesh::Edge& e) {
  int gain = 0;
  for (const auto& [v, step] : {std::pair{e.a, -1}, {e.b, -1}, {e.c, 1}, {e.d, 1}}) {
    const int excess = static_cast<int>(mesh.degree(v)) - regular(mesh, v);
    gain += excess * excess - (excess + step) * (excess + step);
  }
  return gain;
}

/// The centroid of the triangles around a vertex, each weighted by its area and h^-4.
Vec centroid_around(const WorkMesh& mesh, std::uint32_t v) {
  Vec sum;
  double weight = 0;
  for (const std::uint32_t t : mesh.around(v)) {
    const Corners& row = mesh.triangle(t);
    const Vec a = mesh.at(row[0]), b = mesh.at(row[1]), c = mesh.at(row[2]);
    const double h = (mesh.vertex(row[0]).h + mesh.vertex(row[1]).h + mesh.vertex(row[2]).h) / 3;
    const double w = norm(normal_of(a, b, c)) / (h * h * h * h);
    sum += (a + b + c) * (w / 3);
    weight += w;
  }
  return sum * (1 / weight);
}

/// Moves a vertex to the projection of a point if the cost around it is then below `most`.
bool try_move(WorkMesh& mesh, const Surface& surface, const Sizing& sizing, std::uint32_t v, Vec to,
              double most, Cost cost) {
  const Place place = project(surface, mesh.vertex(v).place, to);
  if (cost_around(mesh, surface, v, place, cost) >= most) return false;
  mesh.move(v, place, sizing.at(surface, place));
  return true;
}

/// Moves each free vertex to the centroid around it, unless that makes a bad angle worse.
void smooth(WorkMesh& mesh, const Surface& surface, const Sizing& sizing, Progress progress) {
  const double good = std::cos(40 * std::numbers::pi / 180);
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_alive(v) || mesh.vertex(v).kind != Hold::Kind::free) continue;
    progress.tick();
    const double before = cost_around(mesh, surface, v, mesh.vertex(v).place, largest_cosine);
    try_move(mesh, surface, sizing, v, centroid_around(mesh, v), std::max(before + 0.01, good),
             largest_cosine);
  }
}

/// Moves a vertex in its tangent plane if that improves the worst triangle around it.
bool search_move(WorkMesh& mesh, const Surface& surface, const Sizing& sizing, std::uint32_t v) {
  const double before = cost_around(mesh, surface, v, mesh.vertex(v).place, shape_cost);
  const auto cost = [&](const Place& to) { return cost_around(mesh, surface, v, to, shape_cost); };
  for (double step = 0.2; step > 0.01; step /= 2) {
    const auto best = best_around(mesh, surface, v, step * mesh.vertex(v).h, before - 1e-3, cost);
    if (best && try_move(mesh, surface, sizing, v, *best, before - 1e-4, shape_cost)) return true;
  }
  return false;
}

/// Sum over the triangles around v, with v at `to`, of the square of (a^2 + b^2 + c^2) / (2 area), which is
/// least if they are equilateral; infinity if one turns over.
double distortion_around(const WorkMesh& mesh, const Surface& surface, std::uint32_t v, const Place& to) {
  double sum = 0;
  for (const std::uint32_t t : mesh.around(v)) {
    const Corners& row = mesh.triangle(t);
    const std::size_t k = row[0] == v ? 0 : row[1] == v ? 1 : 2;
    const Vec b = mesh.at(row[(k + 1) % 3]), c = mesh.at(row[(k + 2) % 3]);
    if (turns_over(mesh, surface, row, row, v, to)) return worst;
    const double area = norm(normal_of(to.at, b, c));
    const double d = (norm2(b - to.at) + norm2(c - to.at) + norm2(c - b)) / area;
    sum += d * d;
  }
  return sum;
}

/// Moves each free vertex in its tangent plane if that decreases the distortion around it.
/// \param step  length of the move in units of h
void improve(WorkMesh& mesh, const Surface& surface, const Sizing& sizing, Progress progress, double step) {
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_alive(v) || mesh.vertex(v).kind != Hold::Kind::free) continue;
    progress.tick();
    const double before = distortion_around(mesh, surface, v, mesh.vertex(v).place);
    const auto best = best_around(mesh, surface, v, step * mesh.vertex(v).h, before,
                                  [&](const Place& to) { return distortion_around(mesh, surface, v, to); });
    if (!best) continue;
    const Place place = project(surface, mesh.vertex(v).place, *best);
    if (distortion_around(mesh, surface, v, place) < before) mesh.move(v, place, sizing.at(surface, place));
  }
}

/// Flips edges and moves vertices at the triangles whose shape cost is above 1.
void mend_worst(WorkMesh& mesh, const Surface& surface, const Sizing& sizing, int passes, Progress progress) {
  for (int pass = 0; pass < passes; ++pass) {
    std::vector<std::uint32_t> bad;
    for (const Corners& row : mesh.triangles())
      if (row[0] != row[1] && shape_cost(mesh.at(row[0]), mesh.at(row[1]), mesh.at(row[2])) > 1)
        bad.insert(bad.end(), row.begin(), row.end());
    std::sort(bad.begin(), bad.end());
    bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
    bool any = false;
    for (const std::uint32_t v : bad) {
      progress.tick();
      for (const std::uint32_t u : mesh.neighbors(v)) {
        const auto e = mesh.edge(v, u);
        if (!e || !mesh.can_flip(*e)) continue;
        if (cost_flipped(mesh, surface, *e, shape_cost) >= cost_of(mesh, *e, shape_cost) - 0.005) continue;
        mesh.flip(*e);
        any = true;
      }
      if (mesh.vertex(v).kind == Hold::Kind::free) any |= search_move(mesh, surface, sizing, v);
    }
    if (!any) return;
  }
}

}  // namespace

std::size_t flip_edges(WorkMesh& mesh, const Surface& surface, Progress progress) {
  const double good = std::cos(30 * std::numbers::pi / 180);
  std::size_t flips = 0;
  for (std::uint32_t a = 0; a < mesh.vertex_count(); ++a) {
    if (!mesh.is_alive(a)) continue;
    progress.tick();
    for (const std::uint32_t b : mesh.neighbors(a)) {
      if (b < a) continue;
      const auto e = mesh.edge(a, b);
      if (!e || !mesh.can_flip(*e)) continue;
      const double before = cost_of(mesh, *e, largest_cosine);
      const double after = cost_flipped(mesh, surface, *e, largest_cosine);
      const int gain = degree_gain(mesh, *e);
      const bool better = after < before - 0.01 && (gain >= 0 || before > good);
      if (!better && !(gain >= 2 && after < good)) continue;
      mesh.flip(*e);
      ++flips;
    }
  }
  return flips;
}

void relax(WorkMesh& mesh, const Surface& surface, const Sizing& sizing, int rounds, Progress progress) {
  constexpr int smoothing = 5;  // first rounds, which even out sizes; the others improve shapes
  constexpr std::array<double, 3> steps = {0.1, 0.05, 0.025};  // in units of h
  for (int round = 0; round < rounds; ++round) {
    progress.at(round / (rounds + 1.0));
    flip_edges(mesh, surface, progress);
    if (round < smoothing)
      smooth(mesh, surface, sizing, progress);
    else
      improve(mesh, surface, sizing, progress, steps[static_cast<std::size_t>(round) % steps.size()]);
  }
  progress.at(rounds / (rounds + 1.0));
  if (rounds > 0) mend_worst(mesh, surface, sizing, 30, progress);
}

}  // namespace powercell::remeshing
