#include "lib/integrate/nodal_density.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <powercell/regions.hpp>

#include "lib/base/nodal_values.hpp"
#include "lib/base/threads.hpp"

namespace powercell {
namespace {

using Place = Vector3<double>;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A corner of a simplex, relative to the origin of the integrals, with the density there.
struct DensityCorner {
  Place at{};
  double value = 0;
};

/// Integrals over one cell about a point of it.
struct DensitySums {
  Place origin{};
  double mass = 0, second = 0;
  Place first{};

  /// Adds those over a simplex of that measure (33a).
  template <std::size_t Corners>
  void add(const std::array<DensityCorner, Corners>& simplex, double measure) {
    constexpr double n = Corners - 1, per_mass = n + 1, per_first = per_mass * (n + 2),
                     per_second = per_first * (n + 3);
    Place sum{}, weighted{};
    double total = 0, squares = 0, weighted_squares = 0;
    for (const DensityCorner& corner : simplex) {
      const double square = dot(corner.at, corner.at);
      sum = sum + corner.at;
      weighted = weighted + corner.value * corner.at;
      total += corner.value;
      squares += square;
      weighted_squares += corner.value * square;
    }
    mass += measure * total / per_mass;
    first = first + measure / per_first * (total * sum + weighted);
    second += measure / per_second *
              (total * (dot(sum, sum) + squares) + 2 * (dot(weighted, sum) + weighted_squares));
  }
};

/// The density in one region.
class RegionDensity {
 public:
  RegionDensity(const RegionsView& mesh, std::uint32_t region, std::span<const double> values, double largest)
      : function_(affine_in_region(mesh, region, values)) {
    for (std::uint32_t k = mesh.region_offset[region]; k < mesh.region_offset[region + 1]; ++k) {
      const double value = values[mesh.region_vertex[k]];
      known_ = known_ && value >= 0 && value <= largest;
    }
  }
  double operator()(const Place& x) const { return known_ ? function_(x) : unknown; }

 private:
  AffineFunction function_;
  bool known_ = true;
};

/// Splits the pieces of cells into simplices.
class NodalIntegrator {
 public:
  NodalIntegrator(const Cells& cells, const Domain& domain, std::span<const double> values, double largest)
      : cells_(cells),
        mesh_(domain.regions()),
        low_(domain.low()),
        high_(domain.high()),
        values_(values),
        largest_(largest) {}

  DensitySums over_cell(std::size_t i) const {
    DensitySums sums;
    const std::uint64_t first = cells_.cell_offset[i], end = cells_.cell_offset[i + 1];
    if (first < end) sums.origin = vertex(cells_.vertex_offset[first]);
    for (std::uint64_t piece = first; piece < end; ++piece) {
      const RegionDensity density(mesh_, cells_.region[piece], values_, largest_);
      cells_.cell_dimension == 3 ? add_polyhedron(piece, density, sums) : add_polygon(piece, density, sums);
    }
    return sums;
  }

 private:
  /// Within the box of the domain: where a seed is far away, rounding may put vertices anywhere.
  Place vertex(std::uint64_t v) const {
    Place x{};
    for (std::size_t k = 0; k < 3; ++k) x[k] = std::clamp(cells_.vertices[3 * v + k], low_[k], high_[k]);
    return x;
  }

  DensityCorner corner(std::uint64_t v, const RegionDensity& density, const DensitySums& sums) const {
    const Place x = vertex(v);
    return {x - sums.origin, density(x)};
  }

  void add_polygon(std::uint64_t piece, const RegionDensity& density, DensitySums& sums) const {
    const std::uint64_t begin = cells_.vertex_offset[piece], end = cells_.vertex_offset[piece + 1];
    for (std::uint64_t v = begin + 2; v < end; ++v) {
      const std::array<DensityCorner, 3> simplex{corner(begin, density, sums), corner(v - 1, density, sums),
                                                 corner(v, density, sums)};
      const Place normal = cross(simplex[1].at - simplex[0].at, simplex[2].at - simplex[0].at);
      sums.add(simplex, std::hypot(normal[0], normal[1], normal[2]) / 2);
    }
  }

  void add_polyhedron(std::uint64_t piece, const RegionDensity& density, DensitySums& sums) const {
    const std::uint64_t begin = cells_.vertex_offset[piece];
    const DensityCorner top = corner(begin, density, sums);
    for (std::uint64_t f = cells_.face_offset[piece]; f < cells_.face_offset[piece + 1]; ++f) {
      const std::uint64_t from = cells_.loop_offset[f], to = cells_.loop_offset[f + 1];
      const auto on_face = [&](std::uint64_t k) { return corner(begin + cells_.loop[k], density, sums); };
      for (std::uint64_t k = from + 2; k < to; ++k) {
        const std::array<DensityCorner, 4> simplex{top, on_face(from), on_face(k - 1), on_face(k)};
        // Signed: where rounding turns tetrahedra of a fan inside out, the excess cancels.
        sums.add(simplex,
                 dot(simplex[1].at - top.at, cross(simplex[2].at - top.at, simplex[3].at - top.at)) / 6);
      }
    }
  }

  const Cells& cells_;
  RegionsView mesh_;
  Place low_, high_;
  std::span<const double> values_;
  double largest_;
};

/// The second moment about x, by that about the centroid: x may be far away.
double moved_second_moment(const DensitySums& sums, const Place& x) {
  if (!(sums.mass > 0)) return std::isnan(sums.mass) ? unknown : 0.0;
  const Place centroid{sums.first[0] / sums.mass, sums.first[1] / sums.mass, sums.first[2] / sums.mass},
      way = x - sums.origin - centroid;
  return std::max(sums.second - sums.mass * dot(centroid, centroid), 0.0) + sums.mass * dot(way, way);
}

}  // namespace

NodalIntegrals integrate_nodal(const Cells& cells, const Domain& domain, std::span<const double> values,
                               double largest, std::span<const double> seeds, int threads) {
  const NodalIntegrator integrator(cells, domain, values, largest);
  const std::size_t n = cells.cell_count();
  NodalIntegrals result{std::vector<double>(n), std::vector<double>(3 * n, unknown), std::vector<double>(n)};
  constexpr std::size_t few = 1000;
  parallel_for(threads_for(n, threads, few), n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const DensitySums sums = integrator.over_cell(i);
      result.mass[i] = sums.mass < 0 ? 0 : sums.mass;
      result.second_moment[i] = moved_second_moment(sums, {seeds[3 * i], seeds[3 * i + 1], seeds[3 * i + 2]});
      for (std::size_t k = 0; k < 3 && sums.mass > 0; ++k)
        result.centroid[3 * i + k] = sums.origin[k] + sums.first[k] / sums.mass;
    }
  });
  return result;
}

}  // namespace powercell
