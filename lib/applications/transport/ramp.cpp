#include <cmath>

#include "lib/applications/transport/phases.hpp"

namespace powercell {
namespace {

constexpr double intermediate_tolerance = 0.1;  // of the masses for exponents below 1
constexpr double smallest_stride = 1.0 / 64;    // of the exponent

/// Masses proportional to a power of the target, with the same sum. Computed by logarithms to avoid overflow.
Vector power_of(const Vector& target, double exponent) {
  Vector result = (exponent * (target.array() / target.maxCoeff()).log()).exp();
  return result * (target.sum() / result.sum());
}

}  // namespace

PhaseEnd ramp(SolveContext& context, Iterate& at) {
  double reached = 0, stride = 0.5;
  bool started = false;
  while (true) {
    const double exponent = started ? std::min(1.0, reached + stride) : 0;
    const bool last = exponent == 1;
    const Vector target = last ? context.target() : power_of(context.target(), exponent);
    Iterate trial = at;
    const PhaseEnd end = newton(context, trial, target, last ? context.tolerance() : intermediate_tolerance,
                                last ? TransportPhase::newton : TransportPhase::ramp, exponent);
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
