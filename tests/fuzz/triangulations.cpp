// Regular triangulations of any numbers: facets of one or two simplices, and the hull covered whatever the
// weights.
#include <algorithm>
#include <cmath>
#include <powercell/triangulation.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/exact/check_triangulation.hpp"
#include "tests/fuzz/laws.hpp"
#include "tests/fuzz/refusals.hpp"

namespace powercell::fuzz {
namespace {

/// d! times the measure of all simplices.
long double covered(const Dual& dual, const test::SeedArray& seeds) {
  long double sum = 0;
  for (std::size_t s = 0; s < dual.size(); ++s) sum += test::signed_measure(dual, s, seeds);
  return sum;
}

/// What the simplices refer to, and that they lie beside each other.
Dual checked(const test::SeedArray& seeds, const Options& options) {
  const Dual dual = regular_triangulation(shared_device(), seeds.view(), options);
  const auto corners = static_cast<std::size_t>(seeds.dimension) + 1;
  require(dual.corners == seeds.dimension + 1 && dual.simplices.size() % corners == 0, "no rows of corners");
  for (std::size_t row = 0; row < dual.simplices.size(); row += corners) {
    const auto begin = dual.simplices.begin() + static_cast<std::ptrdiff_t>(row);
    std::vector<std::uint32_t> simplex(begin, begin + static_cast<std::ptrdiff_t>(corners));
    std::ranges::sort(simplex);
    require(simplex.back() < seeds.size(), "a corner that is no seed");
    require(std::ranges::adjacent_find(simplex) == simplex.end(), "a simplex with a corner twice");
  }
  require(test::facet_faults(dual) == 0, "a facet with more than two simplices, or two on one side");
  return dual;
}

/// The largest extent of the positions; infinity where a number is beyond the range in which `covered` says
/// something.
double modest_size(const test::SeedArray& seeds) {
  if (seeds.size() == 0) return INFINITY;
  double low = 1e60, high = -1e60, weight = 0;
  for (const double x : seeds.positions) {
    if (!(std::fabs(x) < 1e60)) return INFINITY;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  const double size = high - low;
  for (const double w : seeds.weights) weight = std::max(weight, std::fabs(w));
  // Heavier seeds put centres beyond the reach of the search.
  return weight <= 1e6 * size * size ? size : INFINITY;
}

std::string description(const test::SeedArray& seeds, long double hull, long double same) {
  std::ostringstream text;
  text << "the hull has the measure " << hull << " with equal weights, " << same << " with others";
  text.precision(17);
  const auto d = static_cast<std::size_t>(seeds.dimension);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    text << "\n  seed " << i << ':';
    for (std::size_t k = 0; k < d; ++k) text << ' ' << seeds.positions[i * d + k];
    text << " weight " << seeds.weights[i];
  }
  return text.str();
}

}  // namespace

void triangulations(Bytes bytes) {
  Input input(bytes);
  test::SeedArray seeds{2 + static_cast<int>(input.below(2)), {}, {}};
  Options options;
  options.threads = 1;
  const std::size_t choice = input.below(4), n = input.below(14);
  if (choice & 1) options.precision = Precision::float32;
  if (choice & 2) options.neighbors = Neighbors::flann;
  seeds.positions = input.numbers(n * static_cast<std::size_t>(seeds.dimension));
  seeds.weights.assign(n, 0);
  accepted(kCallersFaults, [&] {
    const Dual delaunay = checked(seeds, options);
    seeds.weights = input.numbers(n);
    const Dual regular = checked(seeds, options);
    const double size = modest_size(seeds);
    if (!std::isfinite(size)) return;
    const long double hull = covered(delaunay, seeds), same = covered(regular, seeds);
    if (!(std::fabs(hull - same) <= 1e-12L * std::pow(static_cast<long double>(size), seeds.dimension)))
      throw Finding(description(seeds, hull, same));
  });
}

}  // namespace powercell::fuzz
