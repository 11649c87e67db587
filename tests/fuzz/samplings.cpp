// Points of equal mass from any start and density, and what is measured of any points.
#include <cmath>
#include <powercell/point_sets.hpp>
#include <powercell/sampling.hpp>
#include <string>

#include "tests/fuzz/densities.hpp"
#include "tests/fuzz/laws.hpp"
#include "tests/fuzz/refusals.hpp"

namespace powercell::fuzz {
namespace {

/// A density may need more than a sampling can do; points may not find their masses in so few moves.
constexpr auto kRefusals = {ErrorCode::invalid_argument, ErrorCode::invalid_seed, ErrorCode::invalid_domain,
                            ErrorCode::unsupported, ErrorCode::not_converged};

SamplingOptions any_sampling_options(Input& input, const Density& density) {
  SamplingOptions options;
  options.density = density;
  options.mode = input.flag() ? SamplingMode::blue : SamplingMode::quantise;
  options.descent = input.flag() ? SamplingDescent::lloyd : SamplingDescent::lbfgs;
  options.periodic = input.below(8) == 7;
  options.iterations = 1 + static_cast<int>(input.below(3));
  options.random_seed = input.byte();
  if (input.below(16) == 15) {
    options.iterations = static_cast<int>(input.below(6)) - 2;
    options.hexatic = input.number();
    options.movement = input.number();
    options.capacity_tolerance = input.number();
    if (options.iterations == 0) options.iterations = -1;  // the default is too many for here
  }
  if (input.below(4) == 3) options.diagram.precision = Precision::float32;
  options.diagram.threads = 1;
  return options;
}

void check_sample(const SamplingResult& result, std::size_t n, std::size_t d) {
  require(result.positions.size() == n * d && result.weights.size() == n && result.mass.size() == n,
          "points of another number than asked for");
  for (const double x : result.positions) require(std::isfinite(x), "a point that is not finite");
  for (const double w : result.weights) require(std::isfinite(w), "a weight that is not finite");
  for (const double m : result.mass) require(m >= 0, "a mass that is negative or no number");
}

void check_points(const std::vector<double>& points, const Domain& domain, std::size_t n) {
  const auto d = static_cast<std::size_t>(domain.dimension());
  require(points.size() == n * d, "points of another number than asked for");
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double low = domain.low()[k % d], high = domain.high()[k % d];
    const double room = 1e-9 * (std::fabs(low) + std::fabs(high));
    require(points[k] >= low - room && points[k] <= high + room,
            "a random point outside of the domain's box");
  }
}

void check_density(const Density& density, const Domain& domain, Input& input) {
  const SeedInput seeds = any_seeds(input, domain, input.below(8));
  Options options;
  options.threads = 1;
  Diagram diagram(shared_device(), domain, options);
  diagram.set_seeds({domain.dimension(), seeds.positions, seeds.weights});
  const DensityIntegrals integrals = integrate(diagram, density, input.flag(), 1);
  require(integrals.mass.size() == diagram.size() && integrals.second_moment.size() == diagram.size(),
          "integrals of another number than seeds");
  for (const double m : integrals.mass) require(m >= 0, "a mass that is negative or no number");
}

}  // namespace

void samplings(Bytes bytes) {
  Input input(bytes);
  accepted(kRefusals, [&] {
    const Domain domain = make(input.below(8) == 7 ? any_domain(input) : good_domain(input));
    const auto d = static_cast<std::size_t>(domain.dimension());
    const Density density = any_density(input, domain);
    const std::size_t n = input.below(10);
    for (int steps = 0; steps < 4 && !input.at_end(); ++steps)
      accepted(kRefusals, [&] {
        switch (input.below(6)) {
          case 0:
            check_sample(sample(shared_device(), domain, n, any_sampling_options(input, density)), n, d);
            break;
          case 1: {
            const SeedInput seeds = any_seeds(input, domain, n);
            check_sample(
                sample(shared_device(), domain, seeds.positions, any_sampling_options(input, density)), n, d);
            break;
          }
          case 2: {
            const SeedInput seeds = any_seeds(input, domain, n);
            Options options;
            options.threads = 1;
            const Spacing even =
                spacing(shared_device(), domain, seeds.positions, input.below(4) == 3, input.flag(), options);
            require(!(even.least < 0) && !(even.hexatic < 0) && !(even.hexatic > 1 + 1e-9),
                    "spacing out of range");
            break;
          }
          case 3: {
            const SeedInput seeds = any_seeds(input, domain, n);
            const Spectrum power =
                spectrum(domain, seeds.positions, static_cast<int>(input.below(12)) - 2, 1);
            const auto side = static_cast<std::size_t>(2 * power.highest + 1);
            require(power.power.size() == side * side, "a spectrum of another size");
            power.radial();
            power.low_frequency();
            mean(std::vector<Spectrum>(input.below(3), power));
            break;
          }
          case 4:
            check_points(random_points(domain, density, n, input.byte()), domain, n);
            break;
          default:
            check_density(density, domain, input);
        }
      });
  });
}

}  // namespace powercell::fuzz
