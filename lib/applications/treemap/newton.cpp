#include "lib/applications/treemap/newton.hpp"

#include <algorithm>
#include <cmath>

#include "lib/applications/linear/damping.hpp"

namespace powercell::treemap_detail {
namespace {

constexpr int most_steps = 200;     // a safeguard: convergence is quadratic
constexpr int most_halvings = 8;    // of the weights at the start, before equal ones are tried
constexpr double shortest = 1e-6;   // shortest step tried
constexpr double rounding = 1e-12;  // residual in units of the outline's area that may be rounding errors

class DampedNewton {
 public:
  DampedNewton(ConvexDiagram& diagram, LaplacianSolver& laplacian, std::span<const double> target,
               std::vector<double>& weights)
      : diagram_(diagram), laplacian_(laplacian), target_(target), weights_(weights) {}

  NewtonOutcome solve(double tolerance) {
    if (!start()) return outcome_;
    const double share = kept_share(least_ratio());
    least_.resize(target_.size());
    for (std::size_t i = 0; i < least_.size(); ++i) least_[i] = share * target_[i];
    double norm = update_residual();
    while (outcome_.error >= tolerance) {
      if (outcome_.steps == most_steps) return outcome_;
      if (!laplacian_.solve(diagram_.walls(), residual_, delta_)) return outcome_;
      ++outcome_.steps;
      if (!step(norm)) return outcome_;
    }
    outcome_.converged = true;
    return outcome_;
  }

 private:
  bool evaluate(std::span<const double> least) {
    ++outcome_.diagrams;
    return diagram_.compute(weights_, least);
  }

  /// Takes the first of w, w/2, w/4, ..., 0 (with the mean removed) that leaves no cell empty.
  bool start() {
    if (evaluate({})) return true;
    double mean = 0;
    for (const double w : weights_) mean += w / static_cast<double>(weights_.size());
    for (double& w : weights_) w -= mean;
    for (int halvings = 0; halvings < most_halvings; ++halvings) {
      for (double& w : weights_) w *= 0.5;
      if (evaluate({})) return true;
    }
    std::fill(weights_.begin(), weights_.end(), 0.0);
    return evaluate({});
  }

  double least_ratio() const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < target_.size(); ++i) least = std::min(least, diagram_.mass()[i] / target_[i]);
    return least;
  }

  /// Updates the residual and the error.
  /// \return the Euclidean norm of the residual
  double update_residual() {
    residual_.resize(target_.size());
    double squares = 0, error = 0;
    for (std::size_t i = 0; i < target_.size(); ++i) {
      residual_[i] = target_[i] - diagram_.mass()[i];
      squares += residual_[i] * residual_[i];
      error = std::max(error, std::fabs(residual_[i]) / target_[i]);
    }
    outcome_.error = error;
    return std::sqrt(squares);
  }

  /// Goes along delta by 1, 1/2, 1/4, ... until no cell is too small and the residual decreases enough. If
  /// its norm is as small as the rounding of the large cells, a decrease of the error counts, as the small
  /// cells may still improve.
  bool step(double& norm) {
    from_ = weights_;
    const double error = outcome_.error;
    double reached = 0;
    const double length = damped_length(shortest, [&](double trial) {
      for (std::size_t i = 0; i < weights_.size(); ++i) weights_[i] = from_[i] + trial * delta_[i];
      if (!evaluate(least_)) return false;
      reached = update_residual();
      return decreases_enough(reached, norm, trial) ||
             (reached < rounding && decreases_enough(outcome_.error, error, trial));
    });
    if (length > 0) {
      norm = reached;
      return true;
    }
    // Restores the diagram of the last weights. Rounding depends on the order of neighbours, so a cell as
    // thin as a needle may be empty this time.
    weights_ = from_;
    if (evaluate({}))
      update_residual();
    else
      outcome_.error = std::numeric_limits<double>::infinity();
    return false;
  }

  ConvexDiagram& diagram_;
  LaplacianSolver& laplacian_;
  std::span<const double> target_;
  std::vector<double>& weights_;
  std::vector<double> residual_, delta_, least_, from_;
  NewtonOutcome outcome_;
};

}  // namespace

NewtonOutcome damped_newton(ConvexDiagram& diagram, LaplacianSolver& laplacian,
                            std::span<const double> target, std::vector<double>& weights, double tolerance) {
  return DampedNewton(diagram, laplacian, target, weights).solve(tolerance);
}

}  // namespace powercell::treemap_detail
