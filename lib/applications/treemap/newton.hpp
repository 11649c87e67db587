/// \file
/// The damped Newton method for weights that give cells prescribed measures. Internal.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "lib/applications/linear/damping.hpp"

namespace powercell::treemap_detail {

struct NewtonOptions {
  double tolerance = 1e-6;  ///< of every |m_i / nu_i - 1|
  int most_steps = 200;
};

struct NewtonOutcome {
  bool converged = false;
  /// Largest |m_i / nu_i - 1| of the weights left; infinity where a cell is empty, even with equal weights.
  double error = std::numeric_limits<double>::infinity();
  int steps = 0;
  int diagrams = 0;
};

/// Kitagawa, Merigot, Thibert 2019, mathematics (27)-(29). `System` has
///   bool evaluate(weights, least)   the diagram; false where a cell has less than `least` (empty: none) or
///                                   nothing
///   span mass()                     of the diagram last evaluated with true
///   bool step(residual, delta)      solves (15) with it: L delta = residual, the mean of delta free; false
///                                   where rounding leaves no solution, which ends the iteration
/// \param weights  where to start, and what was found
template <class System>
class DampedNewton {
 public:
  DampedNewton(System& system, std::span<const double> target, std::vector<double>& weights)
      : system_(system), target_(target), weights_(weights) {}

  NewtonOutcome solve(const NewtonOptions& options) {
    outcome_ = {};
    if (!start()) return outcome_;
    const double share = kept_share(least_ratio());
    least_.resize(target_.size());
    for (std::size_t i = 0; i < least_.size(); ++i) least_[i] = share * target_[i];
    double norm = take_residual();
    while (outcome_.error >= options.tolerance) {
      if (outcome_.steps == options.most_steps) return outcome_;
      if (!system_.step(residual_, delta_)) return outcome_;
      ++outcome_.steps;
      if (!go(norm)) return outcome_;
    }
    outcome_.converged = true;
    return outcome_;
  }

 private:
  bool evaluate(std::span<const double> least) {
    ++outcome_.diagrams;
    return system_.evaluate(weights_, least);
  }

  // The first of w, w/2, w/4, ..., 0 (mean removed) that leaves no cell empty.
  bool start() {
    if (evaluate({})) return true;
    double mean = 0;
    for (const double w : weights_) mean += w / static_cast<double>(weights_.size());
    for (double& w : weights_) w -= mean;
    for (int halvings = 0; halvings < 8; ++halvings) {
      for (double& w : weights_) w *= 0.5;
      if (evaluate({})) return true;
    }
    std::fill(weights_.begin(), weights_.end(), 0.0);
    return evaluate({});
  }

  double least_ratio() const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < target_.size(); ++i) least = std::min(least, system_.mass()[i] / target_[i]);
    return least;
  }

  double take_residual() {
    residual_.resize(target_.size());
    double squares = 0, error = 0;
    for (std::size_t i = 0; i < target_.size(); ++i) {
      residual_[i] = target_[i] - system_.mass()[i];
      squares += residual_[i] * residual_[i];
      error = std::max(error, std::fabs(residual_[i]) / target_[i]);
    }
    outcome_.error = error;
    return std::sqrt(squares);
  }

  // Along delta by 1, 1/2, 1/4, ... until no cell is too small and the residual falls; its norm then. Where
  // the norm is down to the rounding of the large cells, the small ones may still improve.
  bool go(double& norm) {
    constexpr double rounding = 1e-12, shortest = 1e-6;
    from_ = weights_;
    const double error = outcome_.error;
    double reached = 0;
    const double length = damped_length(shortest, [&](double trial) {
      for (std::size_t i = 0; i < weights_.size(); ++i) weights_[i] = from_[i] + trial * delta_[i];
      if (!evaluate(least_)) return false;
      reached = take_residual();
      return decreases_enough(reached, norm, trial) ||
             (reached < rounding && decreases_enough(outcome_.error, error, trial));
    });
    if (length > 0) {
      norm = reached;
      return true;
    }
    // The system goes back to the diagram of these weights too; cells of needles may be empty this time, as
    // rounding goes with the order of neighbours.
    weights_ = from_;
    if (evaluate({}))
      take_residual();
    else
      outcome_.error = std::numeric_limits<double>::infinity();
    return false;
  }

  System& system_;
  std::span<const double> target_;
  std::vector<double>& weights_;
  std::vector<double> residual_, delta_, least_, from_;
  NewtonOutcome outcome_;
};

}  // namespace powercell::treemap_detail
