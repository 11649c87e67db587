#include <cmath>
#include <powercell/density.hpp>

#include "lib/applications/density/model.hpp"
#include "lib/base/float_environment.hpp"
#include "lib/base/sums.hpp"
#include "lib/base/text.hpp"
#include "lib/base/threads.hpp"

namespace powercell {
namespace {

// Upper limit of an integral of a density: sums of integrals stay within the range of doubles.
constexpr double largest_integral = 1e300;

}  // namespace

Density Density::constant(double value) {
  const FloatEnvironment environment;
  return Density(make_constant(value));
}
Density Density::formula(std::string_view expression, double tolerance) {
  const FloatEnvironment environment;
  return Density(make_formula(expression, tolerance));
}
Density Density::function(std::function<double(const std::array<double, 3>&)> value, double tolerance) {
  const FloatEnvironment environment;
  return Density(make_function(std::move(value), tolerance));
}
Density Density::image(const ImageView& image) {
  const FloatEnvironment environment;
  return Density(make_image(image));
}
Density Density::nodal(std::span<const double> values) {
  const FloatEnvironment environment;
  return Density(make_nodal(values));
}

bool Density::is_constant() const {
  return model_->is_constant();
}

bool Density::is_exact() const {
  return model_->exact();
}

double Density::total(const Domain& domain, int threads) const {
  const FloatEnvironment environment;
  const double total = model_->total(domain, thread_count(threads));
  if (!(total <= largest_integral))
    throw Error(ErrorCode::invalid_argument, "the density has the integral " + digits(total, 3) +
                                                 " over the domain; it must be at most " +
                                                 digits(largest_integral));
  return total;
}

DensityIntegrals integrate(Diagram& diagram, const Density& density, const IntegrationOptions& options) {
  const FloatEnvironment environment;
  if (!(options.tolerance >= 0 && options.tolerance < 1))
    throw Error(ErrorCode::invalid_argument, "the tolerance of integrals is " + digits(options.tolerance) +
                                                 "; it must be 0 or between 0 and 1");
  IntegrationOptions resolved = options;
  resolved.threads = thread_count(options.threads);
  if (diagram.domain().is_periodic() && !density.is_constant())
    throw Error(ErrorCode::unsupported,
                "in a periodic domain the density must be constant, since a function of the position has no "
                "periods; use Density::constant");
  if (diagram.has_selection())
    throw Error(ErrorCode::unsupported,
                "integrals of a density are those of all cells; call select_all() before integrate()");
  DensityIntegrals result = density.model().integrate(diagram, resolved);
  result.domain_mass = density.total(diagram.domain(), options.threads);
  return result;
}

DensityIntegrals integrate(Diagram& diagram, const Density& density, bool walls, int threads) {
  const FloatEnvironment environment;
  IntegrationOptions options;
  options.walls = walls;
  options.threads = threads;
  return integrate(diagram, density, options);
}

double DensityIntegrals::total() const {
  const FloatEnvironment environment;
  CompensatedSum<long double> sum;
  for (double m : mass) sum.add(m);
  return sum.value();
}

double DensityIntegrals::relative_error() const {
  const FloatEnvironment environment;
  return std::abs(total() - domain_mass) / domain_mass;
}

}  // namespace powercell
