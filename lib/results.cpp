/// \file
/// Sums over measures.
#include <algorithm>
#include <cmath>
#include <powercell/results.hpp>

namespace powercell {

double Measures::total() const {
  // Neumaier's sum: what an addition rounds away is kept beside it, so a million small cells sum to the
  // domain's measure as exactly as each of them is known.
  double sum = 0, lost = 0;
  for (const double m : mass) {
    const double next = sum + m;
    lost += std::abs(sum) >= std::abs(m) ? (sum - next) + m : (m - next) + sum;
    sum = next;
  }
  return sum + lost;
}

double Measures::relative_error() const {
  return std::abs(total() - domain_measure) / domain_measure;
}

std::size_t Measures::count(SeedStatus s) const {
  return static_cast<std::size_t>(std::count(status.begin(), status.end(), s));
}

}  // namespace powercell
