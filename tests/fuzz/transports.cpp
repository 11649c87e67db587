// A transport solver used in any order of calls, with any numbers and densities.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <powercell/transport.hpp>
#include <string>

#include "tests/fuzz/densities.hpp"
#include "tests/fuzz/laws.hpp"
#include "tests/fuzz/refusals.hpp"

namespace powercell::fuzz {
namespace {

TransportOptions any_transport_options(Input& input, const Domain& domain) {
  TransportOptions options;
  options.density = any_density(input, domain);
  options.max_steps = static_cast<int>(input.below(16));
  options.linear = static_cast<LinearSolver>(input.below(4));
  options.rescale = input.flag();
  options.periodic = input.below(8) == 7;
  if (input.below(8) == 7) options.tolerance = input.number();
  if (input.below(16) == 15) options.linear_residual = input.number();
  if (input.below(4) == 3) options.diagram.precision = Precision::float32;
  options.diagram.threads = 1;
  return options;
}

void check_result(const TransportResult& result, std::size_t n, std::size_t d) {
  require(result.weights.size() == n && result.target.size() == n && result.mass.size() == n &&
              result.second_moment.size() == n && result.merged_with.size() == n &&
              result.centroid.size() == n * d,
          "results of another size than the seeds");
  require(result.error <= std::max(result.tolerance, result.rounding_error) || !result.converged,
          "converged above the tolerance");
  double worst = 0;
  for (std::size_t i = 0; i < n; ++i) {
    require(std::isfinite(result.weights[i]), "a weight that is not finite");
    require(result.mass[i] >= 0 && result.target[i] >= 0, "a mass that is negative or no number");
    require(result.merged_with[i] <= i && result.merged_with[result.merged_with[i]] == result.merged_with[i],
            "merged with a seed that is merged itself");
  }
  if (!result.converged) return;
  std::vector<double> wanted(n, 0), found(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    wanted[result.merged_with[i]] += result.target[i];
    found[result.merged_with[i]] += result.mass[i];
  }
  for (std::size_t i = 0; i < n; ++i)
    if (result.merged_with[i] == i) worst = std::max(worst, std::fabs(found[i] / wanted[i] - 1));
  require(worst <= 1.001 * std::max(result.tolerance, result.rounding_error),
          "converged, with masses off by " + std::to_string(worst));
}

class TransportSession {
 public:
  TransportSession(Input& input, const Domain& domain)
      : input_(input),
        domain_(domain),
        solver_(shared_device(), domain, any_transport_options(input, domain)) {}

  void set_seeds() {
    const SeedInput next = any_seeds(input_, domain_, input_.below(12));
    std::span<const double> weights = next.weights;
    if (input_.flag()) weights = {};
    solver_.set_seeds({domain_.dimension(), next.positions, weights});
    n_ = next.weights.size();
  }

  void step() {
    const auto d = static_cast<std::size_t>(domain_.dimension());
    switch (input_.below(8)) {
      case 0:
        set_seeds();
        break;
      case 1:
        solver_.move_seeds(input_.numbers(n_ * d));
        break;
      case 2:
        solver_.set_weights(input_.numbers(size()));
        break;
      case 3:
        solver_.set_masses(masses());
        break;
      case 4:
        solver_.set_tolerance(input_.number());
        break;
      case 5:
        check_measures(solver_.diagram().measures(), domain_,
                       {domain_.dimension(), solver_.diagram().positions(), {}}, INFINITY);
        break;
      default:
        check_result(solver_.solve(), n_, d);
    }
  }

 private:
  std::size_t size() { return input_.below(16) == 15 ? input_.below(12) : n_; }
  std::vector<double> masses() {
    std::vector<double> masses = input_.numbers(size());
    if (input_.below(4) != 3)
      for (double& mass : masses) mass = std::fabs(mass) + 0.125;
    return masses;
  }

  Input& input_;
  const Domain& domain_;
  TransportSolver solver_;
  std::size_t n_ = 0;
};

}  // namespace

void transports(Bytes bytes) {
  Input input(bytes);
  accepted(kCallersFaults, [&] {
    const Domain domain = make(input.below(8) == 7 ? any_domain(input) : good_domain(input));
    TransportSession session(input, domain);
    accepted(kCallersFaults, [&] { session.set_seeds(); });
    for (int steps = 0; steps < 6 && !input.at_end(); ++steps)
      accepted(kCallersFaults, [&] { session.step(); });
  });
}

}  // namespace powercell::fuzz
