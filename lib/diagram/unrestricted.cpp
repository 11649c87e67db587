#include "lib/diagram/unrestricted.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/base/threads.hpp"
#include "lib/integrate/moment_sums.hpp"

namespace powercell {
namespace {

/// The least radius (12a) of the ball in a cell, relative to the domain's extent: more than the rounding of
/// vertices.
constexpr double least_radius_double = 1e-11, least_radius_float = 1e-3;
/// The error of moments in units of roundoff, relative to the distance from the seed.
constexpr double moment_errors = 64;

using Vector = std::array<double, 3>;

enum class Location : unsigned char { inside, outside, unclear };

/// Locates a cell that does not meet the boundary by a point near its centroid.
class CellLocator {
 public:
  explicit CellLocator(const DiagramSetup& setup)
      : dimension_(setup.domain.dimension()),
        error_(moment_errors * (setup.float32() ? 0x1p-24 : 0x1p-53)),
        locator_(setup.pairs.locator()) {
    const RegionMesh& mesh = setup.domain.mesh();
    double extent = 0, reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      extent = std::max(extent, mesh.high[k] - mesh.low[k]);
      reach = std::max({reach, std::abs(mesh.low[k]), std::abs(mesh.high[k])});
    }
    least_radius_ = std::max((setup.float32() ? least_radius_float : least_radius_double) * extent,
                             64 * std::numeric_limits<double>::epsilon() * reach);
  }

  Location of(const double* seed, const double* centroid, double mass, double second_moment) const {
    // For a cell far from its seed the variance is a difference of nearly equal numbers. Adding their
    // rounding makes sure that it is never too small, and so the radius never too large.
    const double from_seed = second_moment / mass;
    double centroid_from_seed = 0, rounding = error_ * from_seed;
    for (int k = 0; k < dimension_; ++k) {
      const double q = centroid[k] - seed[k];
      centroid_from_seed += q * q;
      rounding += 0x1p-50 * std::abs(q) * (std::abs(centroid[k]) + std::abs(seed[k]));
    }
    const double variance = from_seed - centroid_from_seed + rounding;  // about the centroid
    const double radius = dimension_ == 3 ? 0.055 * mass / variance : 0.11 * mass / std::sqrt(variance);
    const double least = std::max(least_radius_, error_ * std::sqrt(from_seed));
    if (!(variance > 0) || !(radius > least)) return Location::unclear;
    // In a regular mesh a direction may stay within a facet, but hardly all three.
    constexpr Vector directions[] = {{0.61, 0.29, 0.37}, {-0.23, 0.67, -0.41}, {0.13, -0.47, 0.71}};
    for (const Vector& direction : directions) {
      Vector x{};
      for (int k = 0; k < dimension_; ++k) x[k] = centroid[k] + 0.5 * radius * direction[k];
      const int regions = locator_.regions_at(x);
      if (regions == 0) return Location::outside;
      if (regions == 1) return Location::inside;
      if (regions > 1) return Location::unclear;
    }
    return Location::unclear;
  }

 private:
  int dimension_;
  double error_;  // of moments, relative
  RegionLocator locator_;
  double least_radius_ = 0;
};

}  // namespace

std::vector<std::uint32_t> classify_unrestricted_cells(const DiagramSetup& setup, const SeedSet& seeds,
                                                       const Pairs& pairs, Measures& measures) {
  const CellLocator locator(setup);
  const std::size_t container = setup.domain.region_count();
  const auto d = static_cast<std::size_t>(seeds.dimension);
  std::vector<Location> location(seeds.size(), Location::inside);
  parallel_for(setup.threads, seeds.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t rank = begin; rank < end; ++rank) {
      const std::uint64_t pair = pairs.offset[rank];
      const std::size_t i = seeds.input[rank];
      if (pair == pairs.offset[rank + 1] || pairs.region[pair] < container) continue;
      if (!(measures.mass[i] > 0)) continue;
      location[rank] = locator.of(&seeds.positions[rank * d], &measures.centroid[i * d], measures.mass[i],
                                  measures.second_moment[i]);
      if (location[rank] != Location::outside) continue;
      clear_cell(measures, i);
    }
  });
  std::vector<std::uint32_t> unclear;
  for (std::uint32_t rank = 0; rank < location.size(); ++rank)
    if (location[rank] == Location::unclear) unclear.push_back(rank);
  return unclear;
}

}  // namespace powercell
