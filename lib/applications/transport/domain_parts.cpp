#include "lib/applications/transport/domain_parts.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <powercell/regions.hpp>

#include "lib/base/disjoint_sets.hpp"

namespace powercell {
namespace {

constexpr double sample_of_part = 2000;  // points, roughly
constexpr int finest = 8;                // divisions of an edge

/// Per region the number of its part, in the order of the first regions.
std::vector<std::uint32_t> part_of_regions(const RegionsView& view, std::uint32_t& count) {
  DisjointSets sets(view.size());
  for (std::uint32_t r = 0; r < view.size(); ++r)
    for (std::uint32_t f = view.facet_offset[r]; f < view.facet_offset[r + 1]; ++f)
      if (view.facet[f].kind == Border::Kind::interior) sets.unite(r, view.facet[f].index);
  std::vector<std::uint32_t> number(view.size());
  count = 0;
  for (std::uint32_t r = 0; r < view.size(); ++r) {
    const std::uint32_t root = sets.root(r);  // the least of its set
    number[r] = root == r ? count++ : number[root];
  }
  return number;
}

struct Simplex {
  std::array<Place, 4> corner;
  int corners;

  double measure() const {
    const Place n = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    return corners == 3 ? n.norm() / 2 : std::abs(n.dot(corner[3] - corner[0])) / 6;
  }
  Place middle() const {
    Place sum = Place::Zero();
    for (int k = 0; k < corners; ++k) sum += corner[static_cast<std::size_t>(k)];
    return sum / corners;
  }
  /// Mean of x xᵀ: of corners v and their sum s, (Σ v vᵀ + s sᵀ) / (k (k + 1)) with k corners.
  Eigen::Matrix3d second_moment() const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    Place total = Place::Zero();
    for (int k = 0; k < corners; ++k) {
      const Place& v = corner[static_cast<std::size_t>(k)];
      sum += v * v.transpose();
      total += v;
    }
    return (sum + total * total.transpose()) / (corners * (corners + 1));
  }
  Simplex from(const Place& origin) const {
    Simplex moved = *this;
    for (Place& v : moved.corner) v -= origin;
    return moved;
  }
  /// Middles of a regular grid of simplices with `fine` divisions of each edge.
  std::vector<Place> grid(int fine) const {
    std::vector<Place> points;
    const double shift = 1.0 / corners;
    for (int a = 0; a < fine; ++a)
      for (int b = 0; a + b < fine; ++b)
        for (int c = 0; corners == 3 ? c == 0 : a + b + c < fine; ++c) {
          const double u = (a + shift) / fine, v = (b + shift) / fine,
                       w = corners == 3 ? 0 : (c + shift) / fine;
          points.push_back(corner[0] * (1 - u - v - w) + corner[1] * u + corner[2] * v +
                           (corners == 3 ? Place(Place::Zero()) : Place(corner[3] * w)));
        }
    return points;
  }
};

/// Convex polygons as fans of triangles, tetrahedra as they are.
std::vector<Simplex> simplices_of(const RegionsView& view, std::uint32_t region) {
  const auto d = static_cast<std::size_t>(view.dimension);
  const std::uint32_t first = view.region_offset[region], end = view.region_offset[region + 1];
  const auto corner = [&](std::uint32_t k) { return place(view.vertices, view.region_vertex[first + k], d); };
  if (view.shape == RegionShape::tetrahedron) return {{{corner(0), corner(1), corner(2), corner(3)}, 4}};
  std::vector<Simplex> fan;
  for (std::uint32_t k = 2; first + k < end; ++k)
    fan.push_back({{corner(0), corner(k - 1), corner(k), Place::Zero()}, 3});
  return fan;
}

/// Joins parts so that at most `most` are left. \return per part its new number
std::vector<std::uint32_t> join_small(const std::vector<DomainPart>& parts, std::size_t most) {
  std::vector<std::uint32_t> order(parts.size()), number(parts.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return parts[a].measure > parts[b].measure; });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto nearest = [&] {
      std::uint32_t best = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::uint32_t j = 0; j < most; ++j) {
        const double square = (parts[order[j]].centroid - parts[order[k]].centroid).squaredNorm();
        if (square < least) {
          least = square;
          best = j;
        }
      }
      return best;
    };
    number[order[k]] = k < most ? static_cast<std::uint32_t>(k) : nearest();
  }
  return number;
}

using Sample = std::vector<std::pair<Place, double>>;  // points and measures

/// \param covariance  about the centroid, times the measure
void finish(DomainPart& part, const Eigen::Matrix3d& covariance, const Sample& sample) {
  part.axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().transpose();
  for (int k = 0; k < 3; ++k) {
    std::vector<std::pair<double, double>> atoms;
    for (const auto& [x, m] : sample) atoms.emplace_back(part.axes.row(k).dot(x - part.centroid), m);
    part.quantiles[static_cast<std::size_t>(k)] = Quantiles(std::move(atoms));
  }
}

/// Measures and centroids.
std::vector<DomainPart> first_moments(const RegionsView& view, const std::vector<std::uint32_t>& part_of,
                                      std::size_t count) {
  std::vector<DomainPart> parts(count);
  for (std::uint32_t r = 0; r < view.size(); ++r)
    for (const Simplex& simplex : simplices_of(view, r)) {
      const double measure = simplex.measure();
      parts[part_of[r]].measure += measure;
      parts[part_of[r]].centroid += measure * simplex.middle();
    }
  for (DomainPart& part : parts) part.centroid /= part.measure;
  return parts;
}

}  // namespace

Place place(std::span<const double> positions, std::size_t i, std::size_t d) {
  Place p = Place::Zero();
  for (std::size_t c = 0; c < d; ++c) p[static_cast<Eigen::Index>(c)] = positions[i * d + c];
  return p;
}

Quantiles::Quantiles(std::vector<std::pair<double, double>> atoms) {
  std::sort(atoms.begin(), atoms.end());
  double total = 0, below = 0;
  for (const auto& [x, m] : atoms) total += m;
  for (const auto& [x, m] : atoms) {
    knots_.emplace_back((below + m / 2) / total, x);
    below += m;
  }
}

double Quantiles::at(double share) const {
  if (share <= knots_.front().first) return knots_.front().second;
  if (share >= knots_.back().first) return knots_.back().second;
  const auto above = std::upper_bound(knots_.begin(), knots_.end(), share,
                                      [](double s, const auto& knot) { return s < knot.first; });
  const auto [s1, x1] = *above;
  const auto [s0, x0] = *std::prev(above);
  return s1 > s0 ? x0 + (x1 - x0) * (share - s0) / (s1 - s0) : x0;
}

std::size_t count_parts(const Domain& domain) {
  std::uint32_t count = 0;
  part_of_regions(domain.regions(), count);
  return count;
}

std::vector<DomainPart> domain_parts(const Domain& domain, std::size_t most) {
  const RegionsView view = domain.regions();
  std::uint32_t count = 0;
  std::vector<std::uint32_t> part_of = part_of_regions(view, count);
  std::vector<DomainPart> parts = first_moments(view, part_of, count);
  if (count > most) {
    const std::vector<std::uint32_t> number = join_small(parts, most);
    for (std::uint32_t& part : part_of) part = number[part];
    parts = first_moments(view, part_of, most);
  }
  std::vector<std::size_t> regions(parts.size());
  for (const std::uint32_t part : part_of) ++regions[part];
  std::vector<Sample> sample(parts.size());
  std::vector<Eigen::Matrix3d> covariance(parts.size(), Eigen::Matrix3d::Zero());
  for (std::uint32_t r = 0; r < view.size(); ++r) {
    const std::uint32_t part = part_of[r];
    const double per_region = sample_of_part / static_cast<double>(regions[part]);
    const int fine = std::clamp(static_cast<int>(std::pow(per_region, 1.0 / view.cell_dimension)), 1, finest);
    for (const Simplex& simplex : simplices_of(view, r)) {
      const double measure = simplex.measure();
      const std::vector<Place> points = simplex.grid(fine);
      covariance[part] += measure * simplex.from(parts[part].centroid).second_moment();
      for (const Place& x : points)
        sample[part].emplace_back(x, measure / static_cast<double>(points.size()));
    }
  }
  for (std::size_t p = 0; p < parts.size(); ++p) finish(parts[p], covariance[p], sample[p]);
  return parts;
}

}  // namespace powercell
