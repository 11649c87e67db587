#include "lib/applications/density/geometric.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/applications/density/cell_integrals.hpp"
#include "lib/base/sums.hpp"
#include "lib/base/text.hpp"

namespace powercell {
namespace {

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

double mass_of(std::span<const Moments> moments) {
  CompensatedSum<long double> sum;
  for (const Moments& m : moments) sum.add(m.mass);
  return sum.value();
}

/// The second moment about x: that about the centroid, and what the way from there adds. Of cells without
/// mass no centroid is known.
double second_about(const Point& x, const Moments& m) {
  if (!(m.mass > 0)) return std::max(m.second, 0.0);
  const Point centroid{m.first[0] / m.mass, m.first[1] / m.mass, m.first[2] / m.mass};
  const Point way = x - m.origin - centroid;
  return std::max(m.second - m.mass * dot(centroid, centroid), 0.0) + m.mass * dot(way, way);
}

/// Edges as long, beside the width of where the density is, as longest_edge() has them beside the domain's:
/// the root mean square of the way from the middle is 1/√6 of the width of a square, 1/2 of that of a cube.
/// \param moments  of the regions
Grain grain_of(const Domain& domain, std::span<const Moments> moments) {
  Grain grain{longest_edge(domain), longest_edge(domain)};
  const double mass = mass_of(moments);
  if (!(mass > 0) || !std::isfinite(mass)) return grain;
  for (const Moments& m : moments)
    for (std::size_t k = 0; k < 3; ++k) grain.center[k] += (m.first[k] + m.mass * m.origin[k]) / mass;
  double square = 0;
  for (const Moments& m : moments) square += second_about(grain.center, m) / mass;
  constexpr double reach = 3;  // times that: beyond lies a ninth at most, whatever the density
  const double spread = std::sqrt(square);
  const double dense = spread * (domain.cell_dimension() == 3 ? 0.5 : 0.15);
  if (!(dense < grain.dense) || !(dense > 0)) return grain;
  grain.dense = dense;
  grain.radius = reach * spread;
  return grain;
}

}  // namespace

GeometricDensity::Known GeometricDensity::known(const Domain& domain, int threads) const {
  {
    const std::lock_guard lock(mutex_);
    if (last_known_ && last_known_->domain.regions().source.data() == domain.regions().source.data())
      return *last_known_;
  }
  const Cells regions = region_cells(domain.regions());
  // Regions may be many times as large as cells, and as what the density has in them.
  constexpr int more_depth = 10;
  const auto moments = [&](double tolerance, double negligible, const Grain& grain, bool jumps) {
    const auto make = [&] { return integrator(domain, {tolerance, negligible, grain, more_depth, jumps}); };
    return cell_moments(regions, Box(domain), make, threads);
  };
  // What is negligible beside the mean is known once the sum is, roughly, and so is where the density lies
  // and whether it jumps; small jumps are seen with the others' tolerance.
  constexpr double rough = 1e-2;
  const auto jump_in = [](std::span<const Moments> all) { return std::ranges::any_of(all, &Moments::jump); };
  std::vector<Moments> found =
      moments(0, std::numeric_limits<double>::infinity(), {longest_edge(domain)}, false);
  const double negligible = negligible_share * std::abs(mass_of(found)) / domain.measure();
  const Grain grain = grain_of(domain, found);
  const bool jumps = jump_in(moments(rough, negligible, grain, false));
  found = moments(0, negligible, grain, jumps);
  if (!jumps && jump_in(found)) found = moments(0, negligible, grain, true);
  const double total = mass_of(found);
  if (!(total > 0) || !std::isfinite(total))
    throw Error(ErrorCode::invalid_argument, "the density has the integral " + digits(total) +
                                                 " over the domain; it must be positive somewhere");
  const std::lock_guard lock(mutex_);
  last_known_.emplace(Known{domain, total, grain_of(domain, found), jump_in(found)});
  return *last_known_;
}

double GeometricDensity::total(const Domain& domain, int threads) const {
  return known(domain, threads).total;
}

std::vector<double> GeometricDensity::masses(const Domain& domain, const Cells& cells,
                                             const Accuracy& accuracy, int threads) const {
  std::vector<double> result;
  for (const Moments& m : cell_moments(
           cells, Box(domain), [&] { return integrator(domain, accuracy); }, threads))
    result.push_back(m.mass);
  return result;
}

DensityIntegrals GeometricDensity::integrate(Diagram& diagram, const IntegrationOptions& options) const {
  const Domain& domain = diagram.domain();
  const Known about = known(domain, options.threads);
  const double negligible = negligible_share * about.total / domain.measure();
  const auto make = [&] {
    return integrator(domain, {options.tolerance, negligible, about.grain, 0, about.jumps});
  };
  const Cells& cells = diagram.cells();
  const std::vector<double> seeds = diagram.positions();
  const std::vector<Moments> moments = cell_moments(cells, Box(domain), make, options.threads);

  DensityIntegrals result;
  const auto d = static_cast<std::size_t>(cells.dimension);
  result.dimension = cells.dimension;
  result.status = diagram.measures().status;
  result.centroid.reserve(moments.size() * d);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const Moments& m = moments[i];
    // Rounding turns slivers of cells inside out.
    const double below = std::max(0.0, -m.mass), error = m.error + below;
    result.mass.push_back(m.mass + below);
    Point seed{};
    std::copy_n(&seeds[i * d], d, seed.begin());
    result.second_moment.push_back(second_about(seed, m));
    for (std::size_t k = 0; k < d; ++k)
      result.centroid.push_back(m.mass > 0 ? m.origin[k] + m.first[k] / m.mass
                                           : std::numeric_limits<double>::quiet_NaN());
    result.mass_error.push_back(error);
    result.quadrature_error = std::max(result.quadrature_error, error);
  }
  if (options.walls && (!options.walls_if || options.walls_if(result.mass)))
    result.walls = wall_integrals(cells, Box(domain), result.status, make, options.threads);
  return result;
}

}  // namespace powercell
