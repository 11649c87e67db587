#include "lib/applications/transport/gathered.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace powercell {
namespace {

double fraction_of(double x) {
  return x - std::floor(x);
}

/// Where on the circle [0, 1) the widest gap ends.
double end_of_gap(std::vector<double> on_circle) {
  std::ranges::sort(on_circle);
  double end = on_circle.front(), widest = on_circle.front() + 1 - on_circle.back();
  for (std::size_t i = 1; i < on_circle.size(); ++i) {
    const double gap = on_circle[i] - on_circle[i - 1];
    if (gap <= widest) continue;
    widest = gap;
    end = on_circle[i];
  }
  return end;
}

}  // namespace

std::vector<double> gathered(const Domain& domain, std::span<const double> positions) {
  std::vector<double> result = domain.wrapped(positions);
  if (!domain.is_periodic()) return result;
  const auto d = static_cast<std::size_t>(domain.dimension());
  const auto size = static_cast<Eigen::Index>(d);
  const std::size_t n = result.size() / d;
  const auto periods = domain.periods();
  Eigen::MatrixXd vectors = Eigen::MatrixXd::Identity(size, size);  // unit vectors along bounded axes
  for (std::size_t k = 0; k < d; ++k) {
    const Eigen::VectorXd period = Eigen::Map<const Eigen::VectorXd>(periods[k].data(), size);
    if (!period.isZero(0)) vectors.col(static_cast<Eigen::Index>(k)) = period;
  }
  const Eigen::MatrixXd inverse = vectors.inverse();
  Eigen::Map<Eigen::MatrixXd> points(result.data(), size, static_cast<Eigen::Index>(n));
  const Eigen::MatrixXd coordinates = inverse * points;
  for (Eigen::Index k = 0; k < size; ++k) {
    const auto& period = periods[static_cast<std::size_t>(k)];
    const Eigen::VectorXd by = Eigen::Map<const Eigen::VectorXd>(period.data(), size);
    if (by.isZero(0)) continue;
    std::vector<double> on_circle(n);
    for (std::size_t i = 0; i < n; ++i)
      on_circle[i] = fraction_of(coordinates(k, static_cast<Eigen::Index>(i)));
    const double first = end_of_gap(on_circle);
    for (std::size_t i = 0; i < n; ++i) {
      const double moved = on_circle[i] + (on_circle[i] < first ? 1 : 0);
      points.col(static_cast<Eigen::Index>(i)) +=
          std::round(moved - coordinates(k, static_cast<Eigen::Index>(i))) * by;
    }
  }
  return result;
}

}  // namespace powercell
