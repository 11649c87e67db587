#include <cmath>

#include "lib/applications/transport/course.hpp"

namespace powercell {
namespace {

constexpr double rough = 0.1;  // tolerance of what is not the last target
constexpr double smallest_stride = 1.0 / 64;

/// Proportional to a power of the target, with its sum. Logarithms, so that nothing overflows.
Vector power_of(const Vector& target, double exponent) {
  Vector result = (exponent * (target.array() / target.maxCoeff()).log()).exp();
  return result * (target.sum() / result.sum());
}

}  // namespace

PhaseEnd ramp(Course& course, Iterate& at) {
  double reached = 0, stride = 0.5;
  bool started = false;
  while (true) {
    const double exponent = started ? std::min(1.0, reached + stride) : 0;
    const bool last = exponent == 1;
    const Vector target = last ? course.target() : power_of(course.target(), exponent);
    Iterate trial = at;
    const PhaseEnd end = newton(course, trial, target, last ? course.tolerance() : rough,
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
