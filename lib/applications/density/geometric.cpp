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

/// The longest edge of the simplices that show where a density lies: about a thousand of them in a domain
/// about as long as wide, and at most 128 along it. In space shorter edges find no more of the peaks wider
/// than 1/300 of a cube, and cost up to twice as much for eighths of the domain that are hard throughout.
double longest_region_edge(const Domain& domain) {
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

/// The second moment about x, by the parallel axis theorem from that about the centroid. (A cell without mass
/// has no centroid.)
double second_about(const Point& x, const Moments& m) {
  if (!(m.mass > 0)) return std::max(m.second, 0.0);
  const Point centroid{m.first[0] / m.mass, m.first[1] / m.mass, m.first[2] / m.mass};
  const Point way = x - m.origin - centroid;
  return std::max(m.second - m.mass * dot(centroid, centroid), 0.0) + m.mass * dot(way, way);
}

/// Edges as short relative to the extent of the density as longest_region_edge() is relative to the domain:
/// the root mean square distance from the middle is 1/√6 of the width of a square and 1/2 of that of a cube.
/// \param moments  of the regions
Resolution resolution_of(const Domain& domain, std::span<const Moments> moments) {
  Resolution resolution{longest_region_edge(domain), longest_region_edge(domain)};
  const double mass = mass_of(moments);
  if (!(mass > 0) || !std::isfinite(mass)) return resolution;
  for (const Moments& m : moments)
    for (std::size_t k = 0; k < 3; ++k) resolution.center[k] += (m.first[k] + m.mass * m.origin[k]) / mass;
  double square = 0;
  for (const Moments& m : moments) square += second_about(resolution.center, m) / mass;
  constexpr double reach = 3;  // standard deviations: at most a ninth of any density lies farther (Chebyshev)
  const double deviation = std::sqrt(square);
  const double in_ball = deviation * (domain.cell_dimension() == 3 ? 0.5 : 0.15);
  if (!(in_ball < resolution.in_ball) || !(in_ball > 0)) return resolution;
  resolution.in_ball = in_ball;
  resolution.radius = reach * deviation;
  return resolution;
}

}  // namespace

GeometricDensity::Summary GeometricDensity::summary(const Domain& domain, int threads) const {
  {
    const std::lock_guard lock(mutex_);
    if (last_summary_ && last_summary_->domain.regions().source.data() == domain.regions().source.data())
      return *last_summary_;
  }
  if (domain.is_solid())
    throw Error(ErrorCode::unsupported,
                "a solid takes no density but a constant one; give a tetrahedral mesh of the solid "
                "(Domain::volume)");
  const Cells regions = region_cells(domain.regions());
  // Regions may be many times as large as cells and as the features of the density.
  constexpr int extra_depth = 10;
  const auto moments = [&](double tolerance, double negligible, const Resolution& resolution, bool jumps) {
    const auto make = [&] {
      return integrator(domain, {tolerance, negligible, resolution, extra_depth, jumps});
    };
    return cell_moments(regions, DomainBox(domain), make, threads);
  };
  // A rough integral gives the mean density, hence what is negligible, and the extent of the density; a
  // second one shows whether it jumps. Small jumps are found at full tolerance only.
  constexpr double rough = 1e-2;
  const auto jump_in = [](std::span<const Moments> all) { return std::ranges::any_of(all, &Moments::jump); };
  std::vector<Moments> found =
      moments(0, std::numeric_limits<double>::infinity(), {longest_region_edge(domain)}, false);
  const double negligible = negligible_share * std::abs(mass_of(found)) / domain.measure();
  const Resolution resolution = resolution_of(domain, found);
  const bool jumps = jump_in(moments(rough, negligible, resolution, false));
  found = moments(0, negligible, resolution, jumps);
  if (!jumps && jump_in(found)) found = moments(0, negligible, resolution, true);
  const double total = mass_of(found);
  if (!(total > 0) || !std::isfinite(total))
    throw Error(ErrorCode::invalid_argument, "the density has the integral " + digits(total) +
                                                 " over the domain; it must be positive somewhere");
  const std::lock_guard lock(mutex_);
  last_summary_.emplace(Summary{domain, total, resolution_of(domain, found), jump_in(found)});
  return *last_summary_;
}

double GeometricDensity::total(const Domain& domain, int threads) const {
  return summary(domain, threads).total;
}

std::vector<double> GeometricDensity::masses(const Domain& domain, const Cells& cells,
                                             const Accuracy& accuracy, int threads) const {
  std::vector<double> result;
  for (const Moments& m : cell_moments(
           cells, DomainBox(domain), [&] { return integrator(domain, accuracy); }, threads))
    result.push_back(m.mass);
  return result;
}

DensityIntegrals GeometricDensity::integrate(Diagram& diagram, const IntegrationOptions& options) const {
  const Domain& domain = diagram.domain();
  const Summary whole = summary(domain, options.threads);
  const double negligible = negligible_share * whole.total / domain.measure();
  const auto make = [&] {
    return integrator(domain, {options.tolerance, negligible, whole.resolution, 0, whole.jumps});
  };
  const Cells& cells = diagram.cells();
  const std::vector<double> seeds = diagram.positions();
  const std::vector<Moments> moments = cell_moments(cells, DomainBox(domain), make, options.threads);

  DensityIntegrals result;
  const auto d = static_cast<std::size_t>(cells.dimension);
  result.dimension = cells.dimension;
  result.status = diagram.measures().status;
  result.centroid.reserve(moments.size() * d);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const Moments& m = moments[i];
    // Rounding may turn a sliver inside out.
    const double negative = std::max(0.0, -m.mass), error = m.error + negative;
    result.mass.push_back(m.mass + negative);
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
    result.walls = wall_integrals(cells, DomainBox(domain), result.status, make, options.threads);
  return result;
}

}  // namespace powercell
