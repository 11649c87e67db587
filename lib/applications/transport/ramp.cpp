#include <cmath>
#include <limits>

#include "lib/applications/transport/phases.hpp"

namespace powercell {
namespace {

constexpr double intermediate_tolerance = 0.1;  // of the masses for exponents below 1
constexpr double smallest_stride = 1.0 / 64;    // of the exponent
// Of masses that approach the target: the share that may lack, and the factor by which starved cells grow.
constexpr double approach_tolerance = 0.67, growth = 5;

/// Masses proportional to a power of these, with the same sum. Computed by logarithms to avoid overflow.
Vector power_of(const AllSeeds& all, const Vector& mass, double exponent) {
  const double largest = all.greatest_of(mass);
  Vector result = (exponent * (mass.array() / largest).log()).exp();  // 0 where there is no mass
  return result * (all.sum_of(mass) / all.sum_of(result));
}

/// The same for the masses in each part of the domain: then none crosses a gap that does not in the end.
Vector power_of(SolveContext& context, double exponent) {
  if (context.shares().empty()) return power_of(context.evaluator().all(), context.target(), exponent);
  std::vector<double> sum, largest, power;  // per part
  for (const PartShare& share : context.shares()) {
    if (share.part >= sum.size())
      for (auto* values : {&sum, &largest, &power}) values->resize(share.part + 1);
    sum[share.part] += share.mass;
    largest[share.part] = std::max(largest[share.part], share.mass);
  }
  const auto raised = [&](const PartShare& share) {
    return std::exp(exponent * std::log(share.mass / largest[share.part]));
  };
  for (const PartShare& share : context.shares()) power[share.part] += raised(share);
  Vector result = Vector::Zero(context.target().size());
  for (const PartShare& share : context.shares())
    result[share.seed] += raised(share) * sum[share.part] / power[share.part];
  return result * (context.target().sum() / result.sum());
}

/// The exponent whose masses are nearest to those that the start has in the parts; 0 without such a start.
double first_exponent(SolveContext& context, const Iterate& at) {
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (const double exponent : {0.0, 0.25, 0.5, 0.75}) {
    if (context.shares().empty()) break;
    const Vector target = power_of(context, exponent);
    const double off = at.gradient_norm(target) / at.all->norm(target);
    if (off >= least) continue;
    least = off;
    best = exponent;
  }
  return best;
}

}  // namespace

PhaseEnd approach(SolveContext& context, Iterate& at, const Vector& target, double least) {
  const AllSeeds& all = context.evaluator().all();
  while (at.least(target) < least) {
    const Vector to_go = (target.array() / at.mass().array()).log();
    const double part = std::min(1.0, std::log(growth) / all.greatest_of(to_go));
    Vector between = at.mass().array() * (part * to_go).array().exp();
    between *= all.sum_of(target) / all.sum_of(between);
    Iterate next = at;
    const PhaseEnd end =
        newton_across_gaps(context, next, {between, approach_tolerance, TransportPhase::ramp, part, true});
    if (end == PhaseEnd::step_limit) return end;
    if (end != PhaseEnd::converged || next.least(target) <= at.least(target)) return PhaseEnd::stalled;
    at = std::move(next);
  }
  return PhaseEnd::converged;
}

PhaseEnd ramp(SolveContext& context, Iterate& at) {
  const double first = first_exponent(context, at);
  double reached = first, stride = 0.5;
  bool started = false;
  while (true) {
    const double exponent = started ? std::min(1.0, reached + stride) : first;
    const bool last = exponent == 1;
    const Vector target = last ? context.target() : power_of(context, exponent);
    Iterate trial = at;
    const PhaseEnd end = newton_across_gaps(context, trial,
                                            {target, last ? context.tolerance() : intermediate_tolerance,
                                             last ? TransportPhase::newton : TransportPhase::ramp, exponent});
    if (end == PhaseEnd::step_limit || (end == PhaseEnd::converged && last)) {
      at = std::move(trial);
      return end;
    }
    if (end == PhaseEnd::converged) {
      at = std::move(trial);
      if (started) stride *= 2;
      reached = exponent;
      started = true;
    } else if (!started || stride / 2 < smallest_stride) {
      return end;
    } else {
      stride /= 2;
    }
  }
}

}  // namespace powercell
