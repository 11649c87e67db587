#include "lib/density/geometric.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/density/cell_integrals.hpp"
#include "lib/density/region_cells.hpp"
#include "lib/digits.hpp"
#include "lib/domain/measure.hpp"

namespace powercell {
namespace {

double sum_of(const std::vector<Moments>& moments) {
  CompensatedSum sum;
  for (const Moments& m : moments) sum.add(m.mass);
  return sum.value();
}

constexpr double negligible_share = 1e-3;  // of the mean density

/// Of the parts that show where a density lies: some thousand in a domain about as long as wide, and never
/// more than 128 one behind the other. In space smaller ones find no more of peaks from 1/300 of a cube on,
/// and cost up to twice as much for eighths where all of the domain is hard.
double longest_edge(const Domain& domain) {
  const int d = domain.cell_dimension();
  double square = 0;
  for (std::size_t c = 0; c < static_cast<std::size_t>(domain.dimension()); ++c)
    square += (domain.high()[c] - domain.low()[c]) * (domain.high()[c] - domain.low()[c]);
  return std::max(std::pow(domain.measure(), 1.0 / d) / (d == 3 ? 4 : 16), std::sqrt(square) / 128);
}

}  // namespace

double GeometricDensity::total(const Domain& domain, int threads) const {
  {
    const std::lock_guard lock(mutex_);
    if (known_ && &known_->domain.mesh() == &domain.mesh()) return known_->total;
  }
  const Cells regions = region_cells(domain.mesh());
  // Regions may be many times as large as cells, and as what the density has in them.
  constexpr int more_depth = 10;
  const auto sum = [&](double negligible) {
    const auto make = [&] { return integrator(domain, {0, negligible, longest_edge(domain), more_depth}); };
    return sum_of(cell_moments(regions, {}, make, threads));
  };
  // What is negligible beside the mean is known once the sum is, roughly.
  const double rough = sum(std::numeric_limits<double>::infinity());
  const double total = sum(negligible_share * std::abs(rough) / domain.measure());
  if (!(total > 0) || !std::isfinite(total))
    throw Error(ErrorCode::invalid_argument, "the density has the integral " + digits(total) +
                                                 " over the domain; it must be positive somewhere");
  const std::lock_guard lock(mutex_);
  known_.emplace(Known{domain, total});
  return total;
}

std::vector<double> GeometricDensity::masses(const Domain& domain, const Cells& cells,
                                             const Accuracy& accuracy, int threads) const {
  std::vector<double> result;
  for (const Moments& m : cell_moments(
           cells, {}, [&] { return integrator(domain, accuracy); }, threads))
    result.push_back(m.mass);
  return result;
}

DensityIntegrals GeometricDensity::integrate(Diagram& diagram, const IntegrationOptions& options) const {
  const Domain& domain = diagram.domain();
  const double negligible = negligible_share * total(domain, options.threads) / domain.measure();
  const auto make = [&] {
    return integrator(domain, {options.tolerance, negligible, longest_edge(domain), 0});
  };
  const Cells& cells = diagram.cells();
  const std::vector<double> seeds = diagram.positions();
  const std::vector<Moments> moments = cell_moments(cells, seeds, make, options.threads);

  DensityIntegrals result;
  const auto d = static_cast<std::size_t>(cells.dimension);
  result.dimension = cells.dimension;
  result.status = diagram.measures().status;
  result.centroid.reserve(moments.size() * d);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const Moments& m = moments[i];
    result.mass.push_back(m.mass);
    result.second_moment.push_back(m.second);
    for (std::size_t k = 0; k < d; ++k)
      result.centroid.push_back(m.mass > 0 ? seeds[i * d + k] + m.first[k] / m.mass
                                           : std::numeric_limits<double>::quiet_NaN());
    result.mass_error.push_back(m.error);
    result.quadrature_error = std::max(result.quadrature_error, m.error);
  }
  if (options.walls && (!options.walls_if || options.walls_if(result.mass)))
    result.walls = wall_integrals(cells, result.status, make, options.threads);
  return result;
}

}  // namespace powercell
