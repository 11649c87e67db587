#include "lib/applications/density/simplex_rule.hpp"

#include <cmath>

namespace powercell {
namespace {

/// Calls `body(beta)` for all beta of n+1 natural numbers that sum to k.
template <class Body>
void for_sums(int n, int k, const Body& body) {
  std::array<int, 4> beta{};
  for (beta[0] = 0; beta[0] <= k; ++beta[0])
    for (beta[1] = 0; beta[0] + beta[1] <= k; ++beta[1])
      for (beta[2] = 0; beta[0] + beta[1] + beta[2] <= k; ++beta[2]) {
        beta[3] = k - beta[0] - beta[1] - beta[2];
        const bool has_unused = (n < 3 && beta[3] > 0) || (n < 2 && beta[2] > 0);
        if (!has_unused) body(beta);
      }
}

/// Appends the points (2 beta + 1) / (2k + n + 1) for all beta that sum to k.
void add_points(int n, int k, std::vector<Barycentric>& points) {
  for_sums(n, k, [&](const std::array<int, 4>& beta) {
    Barycentric point{};
    for (int c = 0; c <= n; ++c) point[c] = (2.0 * beta[c] + 1) / (2 * k + n + 1);
    points.push_back(point);
  });
}

std::vector<Barycentric> lattice_on_boundary(int n, int parts) {
  std::vector<Barycentric> points;
  for_sums(n, parts, [&](const std::array<int, 4>& beta) {
    int zeros = 0;
    for (int c = 0; c <= n; ++c) zeros += beta[c] == 0 ? 1 : 0;
    if (zeros == 0 || zeros == n) return;
    Barycentric point{};
    for (int c = 0; c <= n; ++c) point[c] = static_cast<double>(beta[c]) / parts;
    points.push_back(point);
  });
  return points;
}

double factorial(int k) {
  double product = 1;
  for (; k > 1; --k) product *= k;
  return product;
}

SimplexRules make_rules(int n) {
  SimplexRules rules;
  for (int s = 0; s < static_cast<int>(SimplexRules::count); ++s) {
    add_points(n, s, rules.point);
    rules.size[s] = rules.point.size();
    const int degree = 2 * s + 1;
    for (int k = 0; k <= s; ++k) {
      const int i = s - k;
      const double weight = (i % 2 ? -1 : 1) * std::pow(2.0, -2 * s) * std::pow(degree + n - 2 * i, degree) /
                            (factorial(i) * factorial(degree + n - i)) * factorial(n);
      rules.weight[s][k] = weight;
    }
  }
  return rules;
}

}  // namespace

const SimplexRules& simplex_rules(int dimension) {
  static const std::array<SimplexRules, 3> rules{make_rules(1), make_rules(2), make_rules(3)};
  return rules[static_cast<std::size_t>(dimension - 1)];
}

const std::vector<Barycentric>& boundary_points(int dimension) {
  static const std::array<std::vector<Barycentric>, 3> points{
      std::vector<Barycentric>{}, lattice_on_boundary(2, 8), lattice_on_boundary(3, 4)};
  return points[static_cast<std::size_t>(dimension - 1)];
}

}  // namespace powercell
