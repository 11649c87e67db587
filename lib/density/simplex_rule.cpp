#include "lib/density/simplex_rule.hpp"

#include <cmath>

namespace powercell {
namespace {

/// Appends the points (2 beta + 1) / (2k + n + 1) for all beta of n+1 whole numbers that sum to k.
void add_points(int n, int k, std::vector<std::array<double, 4>>& points) {
  std::array<int, 4> beta{};
  for (beta[0] = 0; beta[0] <= k; ++beta[0])
    for (beta[1] = 0; beta[0] + beta[1] <= k; ++beta[1])
      for (beta[2] = 0; beta[0] + beta[1] + beta[2] <= k; ++beta[2])
        for (beta[3] = 0; beta[0] + beta[1] + beta[2] + beta[3] <= k; ++beta[3]) {
          if (beta[0] + beta[1] + beta[2] + beta[3] != k) continue;
          if ((n < 3 && beta[3] > 0) || (n < 2 && beta[2] > 0)) continue;
          std::array<double, 4> point{};
          for (int c = 0; c <= n; ++c) point[c] = (2.0 * beta[c] + 1) / (2 * k + n + 1);
          points.push_back(point);
        }
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

}  // namespace powercell
