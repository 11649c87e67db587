#include <algorithm>
#include <cmath>
#include <powercell/results.hpp>

#include "lib/base/float_environment.hpp"
#include "lib/base/sums.hpp"

namespace powercell {

double Measures::total() const {
  const FloatEnvironment environment;
  CompensatedSum<double> sum;
  for (const double m : mass) sum.add(m);
  return sum.value();
}

double Measures::relative_error() const {
  const FloatEnvironment environment;
  return std::abs(total() - domain_measure) / domain_measure;
}

std::size_t Measures::count(SeedStatus s) const {
  return static_cast<std::size_t>(std::count(status.begin(), status.end(), s));
}

}  // namespace powercell
