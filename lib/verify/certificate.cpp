#include "lib/verify/certificate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <powercell/error.hpp>
#include <string>

#include "lib/base/text.hpp"
#include "lib/base/threads.hpp"
#include "lib/domain/random_points.hpp"
#include "lib/verify/asymmetry.hpp"
#include "lib/verify/laws.hpp"
#include "lib/verify/partition.hpp"

namespace powercell {
namespace {

constexpr double certified_double = 1e-12, certified_float = 1e-6;
/// In units of the largest wall. Each side of a wall is measured in coordinates relative to its own seed.
constexpr double asymmetry_double = 1e-9, asymmetry_float = 1e-3;
/// Roundings that add up in a position relative to a seed, and in a power distance.
constexpr double place_roundings = 64, power_roundings = 16;
constexpr std::size_t points = 8;

[[noreturn]] void refuse_result(const std::string& what) {
  throw Error(ErrorCode::internal, "the certificate of the diagram does not hold: " + what);
}

double unit_of(const Certified& r) {
  return r.float32 ? 0x1p-24 : 0x1p-53;
}

/// The greatest distance, along an axis, of a seed with a cell from the domain's box. Coordinates relative to
/// such a seed have the rounding of that distance.
double farthest_outside(const Certified& r) {
  const auto d = static_cast<std::size_t>(r.seeds.dimension);
  const std::array<double, 3> low = r.domain.low(), high = r.domain.high();
  double farthest = 0;
  for (std::size_t rank = 0; rank < r.seeds.size(); ++rank)
    for (std::size_t k = 0; k < d; ++k) {
      const double p = r.seeds.positions[rank * d + k], outside = std::max(low[k] - p, p - high[k]);
      if (outside > farthest && r.measures.status[r.seeds.input[rank]] == SeedStatus::ok) farthest = outside;
    }
  return farthest;
}

/// The seeds in the caller's order, for tolerances that are seldom needed.
class Callers {
 public:
  explicit Callers(const Certified& r)
      : positions_(r.seeds.input_count * static_cast<std::size_t>(r.seeds.dimension)),
        weights_(r.seeds.input_count),
        rounding_(extent_of(r.domain), view(r), r.float32 ? Precision::float32 : Precision::float64) {}

  const Rounding& rounding() const { return rounding_; }

 private:
  SeedsView view(const Certified& r) {
    const auto d = static_cast<std::size_t>(r.seeds.dimension);
    for (std::size_t rank = 0; rank < r.seeds.size(); ++rank) {
      const std::size_t i = r.seeds.input[rank];
      std::copy_n(&r.seeds.positions[rank * d], d, &positions_[i * d]);
      weights_[i] = r.seeds.weights[rank];
    }
    return {r.seeds.dimension, positions_, weights_};
  }

  std::vector<double> positions_, weights_;
  Rounding rounding_;
};

void require_partition(const Certified& r, double outside) {
  const double error = r.measures.mass.empty() ? 0 : r.measures.relative_error();
  const double usual = r.float32 ? certified_float : certified_double;
  if (error <= usual) return;
  const double reach = std::sqrt(3.0) * (extent_of(r.domain).longest() + outside);
  double tolerance = partition_tolerance(r.domain.mesh(), usual, reach);
  if (error > tolerance && r.domain.kind() == DomainKind::surface && r.geometry)
    tolerance += static_cast<double>(slanted_area(r.geometry(), r.domain.mesh(), Callers(r).rounding())) /
                 r.measures.domain_measure;
  if (error <= tolerance) return;
  refuse_result("the cells measure " + digits(r.measures.total()) + " together, the domain " +
                digits(r.measures.domain_measure));
}

/// Refuses masses, second moments and centroids that no cell of the domain can have; names the first such
/// seed.
void require_numbers(const Certified& r, double outside) {
  const auto d = static_cast<std::size_t>(r.measures.dimension);
  const std::array<double, 3> low = r.domain.low(), high = r.domain.high();
  double reach = 0;
  for (std::size_t k = 0; k < d; ++k) reach = std::max({reach, std::abs(low[k]), std::abs(high[k])});
  const double slack = extent_of(r.domain).longest() * (r.float32 ? 1e-4 : 1e-8) + reach * 1e-14 +
                       place_roundings * unit_of(r) * outside;
  const std::size_t wrong = first_of(r.measures.mass.size(), r.threads, [&](std::size_t i) {
    if (!(r.measures.mass[i] >= 0) || !(r.measures.second_moment[i] >= 0)) return true;
    if ((r.measures.status[i] == SeedStatus::ok) != (r.measures.mass[i] > 0)) return true;
    if (r.measures.status[i] != SeedStatus::ok) return false;
    for (std::size_t k = 0; k < d && !r.domain.is_periodic(); ++k) {
      const double x = r.measures.centroid[i * d + k];
      if (!(x >= low[k] - slack && x <= high[k] + slack)) return true;
    }
    return false;
  });
  if (wrong < r.measures.mass.size())
    refuse_result("seed " + std::to_string(wrong) + " has the mass " + digits(r.measures.mass[wrong]) +
                  " or a centroid that no cell of the domain has");
}

void require_symmetry(const Certified& r, double outside) {
  if (r.adjacency == nullptr || r.adjacency->wall.empty()) return;
  const double largest = *std::max_element(r.adjacency->wall.begin(), r.adjacency->wall.end());
  const double rounding = place_roundings * unit_of(r) * (extent_of(r.domain).longest() + outside) *
                          extent_of(r.domain).rim_of(largest);
  if (r.adjacency->asymmetry <= largest * (r.float32 ? asymmetry_float : asymmetry_double) + rounding) return;
  if (r.adjacency->asymmetry <= allowed_asymmetry(*r.adjacency, &r.domain.mesh(), Callers(r).rounding()))
    return;
  refuse_result(text_of_asymmetry(*r.adjacency));
}

struct Power {
  double value;  // |x-p|^2 - w
  double terms;  // |x-p|^2 + |w|, which determines the rounding of the value
};

template <std::size_t d>
Power power(const SeedSet& seeds, std::size_t i, const std::array<double, 3>& x) {
  double square = 0;
  for (std::size_t k = 0; k < d; ++k) {
    const double q = x[k] - seeds.positions[i * d + k];
    square += q * q;
  }
  return {square - seeds.weights[i], square + std::abs(seeds.weights[i])};
}

/// The rank of least power distance from x. The least value is found first, in vector lanes, then its rank.
template <std::size_t d>
std::size_t owner_of(const SeedSet& seeds, const std::array<double, 3>& x) {
  constexpr std::size_t lanes = 8;
  std::array<double, lanes> least;
  least.fill(std::numeric_limits<double>::infinity());
  std::size_t i = 0;
  for (; i + lanes <= seeds.size(); i += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double here = power<d>(seeds, i + lane, x).value;
      least[lane] = here < least[lane] ? here : least[lane];
    }
  for (; i < seeds.size(); ++i) least[0] = std::min(least[0], power<d>(seeds, i, x).value);
  const double of_all = *std::min_element(least.begin(), least.end());
  for (i = 0; i + 1 < seeds.size() && power<d>(seeds, i, x).value != of_all;) ++i;
  return i;
}

/// The rank of a seed with a cell whose power distance from x is the least up to rounding; if there is none,
/// the rank of least power distance.
template <std::size_t d>
std::size_t owner_with_cell(const Certified& r, const std::array<double, 3>& x) {
  const auto has_cell = [&](std::size_t rank) {
    return r.measures.status[r.owners.input[rank]] == SeedStatus::ok;
  };
  const std::size_t owner = owner_of<d>(r.owners, x);
  if (has_cell(owner)) return owner;
  const Power least = power<d>(r.owners, owner, x);
  for (std::size_t rank = 0; rank < r.owners.size(); ++rank) {
    const Power here = power<d>(r.owners, rank, x);
    const double rounding = power_roundings * 0x1p-53 * (here.terms + least.terms);
    if (here.value - least.value <= rounding && has_cell(rank)) return rank;
  }
  return owner;
}

void require_owners(const Certified& r) {
  if (r.owners.size() == 0) return;
  const std::vector<Sample> samples = random_points(r.domain.mesh(), points, r.seeds.size());
  std::vector<std::size_t> owner(samples.size());
  parallel_for(r.threads, samples.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Vector& point = samples[k].point;
      const std::array<double, 3> x{static_cast<double>(point[0]), static_cast<double>(point[1]),
                                    static_cast<double>(point[2])};
      owner[k] = r.seeds.dimension == 2 ? owner_with_cell<2>(r, x) : owner_with_cell<3>(r, x);
    }
  });
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const std::size_t i = r.owners.input[owner[k]];
    if (r.measures.status[i] == SeedStatus::ok) continue;
    refuse_result("seed " + std::to_string(i) + " has no cell, but owns the point (" +
                  digits(static_cast<double>(samples[k].point[0])) + ", " +
                  digits(static_cast<double>(samples[k].point[1])) + ", " +
                  digits(static_cast<double>(samples[k].point[2])) + ")");
  }
}

}  // namespace

void require_certificate(const Certified& result) {
  const double outside = farthest_outside(result);
  require_partition(result, outside);
  require_numbers(result, outside);
  require_symmetry(result, outside);
  require_owners(result);
}

}  // namespace powercell
