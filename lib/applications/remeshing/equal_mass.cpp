#include "lib/applications/remeshing/equal_mass.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <powercell/transport.hpp>
#include <string>

#include "lib/applications/remeshing/work_mesh.hpp"

namespace powercell::remeshing {
namespace {

struct Points {
  std::vector<std::uint32_t> seed;  ///< index in the sampling
  std::vector<Place> place;
  std::vector<double> share;  ///< mass relative to the cell of a free seed

  std::vector<double> positions() const {
    std::vector<double> result;
    for (const Place& p : place) result.insert(result.end(), {p.at.x, p.at.y, p.at.z});
    return result;
  }
};

/// The angle of the surface around each of its vertices, divided by 2 pi.
std::vector<double> angle_shares(const Surface& surface) {
  std::vector<double> share(surface.vertex.size(), 0);
  for (const auto& row : surface.triangle)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec at = surface.vertex[row[k]];
      const Vec a = surface.vertex[row[(k + 1) % 3]] - at, b = surface.vertex[row[(k + 2) % 3]] - at;
      share[row[k]] += std::atan2(norm(cross(a, b)), dot(a, b)) / (2 * std::numbers::pi);
    }
  return share;
}

/// For each curve, whether it is on the boundary of the surface.
std::vector<bool> at_boundary(const Sampling& sampling) {
  const Surface& surface = sampling.diagram().surface();
  std::vector<bool> result;
  for (std::uint32_t c = 0; c < sampling.curve_count(); ++c) {
    const Curve& curve = sampling.curve(c);
    const auto& row = surface.triangle[curve.triangle.front()];
    bool boundary = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool same =
          std::minmax(row[k], row[(k + 1) % 3]) == std::minmax(curve.vertex[0], curve.vertex[1]);
      boundary |= same && surface.across[curve.triangle.front()][k] == nothing;
    }
    result.push_back(boundary);
  }
  return result;
}

Points points_of(const Sampling& sampling) {
  const LocalDiagram& diagram = sampling.diagram();
  const Surface& surface = diagram.surface();
  const std::vector<double> angle = angle_shares(surface);
  const std::vector<bool> boundary = at_boundary(sampling);
  Points points;
  for (std::uint32_t i = 0; i < diagram.size(); ++i) {
    if (!diagram.seed(i).alive) continue;
    const Hold& hold = sampling.hold(i);
    double share = 1;
    if (hold.kind == Hold::Kind::curve && boundary[hold.curve]) share = 0.5;
    if (hold.kind == Hold::Kind::corner)
      for (const std::uint32_t v : surface.triangle[hold.place.triangle])
        if (surface.vertex[v] == hold.place.at) share = angle[v];
    points.seed.push_back(i);
    points.place.push_back(hold.place);
    points.share.push_back(share);
  }
  return points;
}

Domain domain_of(const Surface& surface) {
  std::vector<double> vertices;
  for (const Vec v : surface.vertex) vertices.insert(vertices.end(), {v.x, v.y, v.z});
  std::vector<std::uint32_t> triangles;
  for (const auto& row : surface.triangle) triangles.insert(triangles.end(), row.begin(), row.end());
  return Domain::surface(vertices, triangles);
}

/// Moves the free points to the centroids.
/// \return the mean displacement in units of h
double move_to_centroids(const Sampling& sampling, const Sizing& sizing, const std::vector<double>& centroid,
                         Points& points) {
  const Surface& surface = sampling.diagram().surface();
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < points.seed.size(); ++k) {
    if (sampling.hold(points.seed[k]).kind != Hold::Kind::free) continue;
    const Vec to{centroid[3 * k], centroid[3 * k + 1], centroid[3 * k + 2]};
    if (!std::isfinite(to.x))
      continue;  // merged with another seed; the dual adds seeds where they are missing
    const Place place = project(surface, points.place[k], to);
    sum += norm(place.at - points.place[k].at) / sizing.at(surface, place);
    count += 1;
    points.place[k] = place;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace

std::vector<Place> equalise_masses(const Sampling& sampling, const Sizing& sizing, const Device& device,
                                   int rounds, Progress progress) {
  constexpr double at_rest = 0.03;  // mean displacement in units of h
  Points points = points_of(sampling);
  std::vector<double> density;
  for (const double h : sizing.h) density.push_back(1 / (h * h));
  TransportOptions options;
  options.density = Density::nodal(density);
  options.tolerance = 0.02;  // the next round changes the masses by more
  options.rescale = true;
  if (progress.has_callback()) options.diagram.progress = [&progress](double) { return progress.report(); };
  TransportSolver solver(device, domain_of(sampling.diagram().surface()), options);
  solver.set_seeds({3, points.positions(), {}});
  solver.set_masses(points.share);
  for (int round = 0; round < rounds; ++round) {
    const TransportResult& result = solver.solve();
    if (!result.converged)
      throw Error(ErrorCode::not_converged,
                  "the masses of the cells could not be made equal: " + std::to_string(result.error) +
                      " is the largest relative error");
    const double moved = move_to_centroids(sampling, sizing, result.centroid, points);
    progress.at(static_cast<double>(round + 1) / rounds);
    if (moved < at_rest) break;
    solver.move_seeds(points.positions());
  }
  std::vector<Place> free;
  for (std::size_t k = 0; k < points.seed.size(); ++k)
    if (sampling.hold(points.seed[k]).kind == Hold::Kind::free) free.push_back(points.place[k]);
  return free;
}

}  // namespace powercell::remeshing
