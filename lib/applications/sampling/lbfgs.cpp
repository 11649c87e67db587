#include "lib/applications/sampling/lbfgs.hpp"

#include <cmath>
#include <numeric>

namespace powercell {
namespace {

// Curvature relative to the lengths of step and change below which a pair is mostly rounding errors.
constexpr double least_curvature = 1e-12;

double dot_product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// a += factor b
void add_scaled(std::vector<double>& a, double factor, const std::vector<double>& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += factor * b[k];
}

}  // namespace

std::vector<double> LbfgsMemory::direction(const std::vector<double>& gradient,
                                           const std::vector<double>& inverse_diagonal) const {
  std::vector<double> q = gradient, along(pairs_.size());
  for (std::size_t k = pairs_.size(); k-- > 0;) {
    along[k] = dot_product(pairs_[k].step, q) / pairs_[k].curvature;
    add_scaled(q, -along[k], pairs_[k].change);
  }
  for (std::size_t k = 0; k < q.size(); ++k) q[k] *= inverse_diagonal[k];
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    add_scaled(q, along[k] - dot_product(pairs_[k].change, q) / pairs_[k].curvature, pairs_[k].step);
  for (double& x : q) x = -x;
  return q;
}

void LbfgsMemory::add(std::vector<double> step, std::vector<double> change) {
  const double curvature = dot_product(step, change);
  if (!(curvature > least_curvature * std::sqrt(dot_product(step, step) * dot_product(change, change))))
    return;
  if (pairs_.size() == most_pairs) pairs_.erase(pairs_.begin());
  pairs_.push_back({std::move(step), std::move(change), curvature});
}

}  // namespace powercell
