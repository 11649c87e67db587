#include "lib/applications/transport/soft_transport.hpp"

#include <cmath>
#include <cstdint>
#include <numeric>

#include "lib/applications/transport/power_tree.hpp"

namespace powercell {

double soften(const Weighted& from, Weighted& to, std::size_t d, double heat) {
  constexpr double cut = 7;  // exp(-7) is negligible for a start
  std::vector<double> raised(from.size());
  const double total = std::accumulate(from.mass.begin(), from.mass.end(), 0.0);
  for (std::size_t i = 0; i < raised.size(); ++i)
    raised[i] = from.weights[i] + heat * std::log(from.mass[i] / total);
  std::vector<std::uint32_t> all(from.size());
  std::iota(all.begin(), all.end(), 0U);
  const PowerTree tree(from.positions, raised, d, std::move(all));
  double entropy = 0, mass = 0;
  for (std::size_t k = 0; k < to.size(); ++k) {
    PowerTree::Point x{};
    for (std::size_t c = 0; c < d; ++c) x[c] = to.positions[k * d + c];
    const double least = tree.least(x);
    double sum = 0, first = 0;
    tree.near(x, least + cut * heat, [&](std::uint32_t, double power) {
      const double u = (least - power) / heat;
      if (u < -cut) return;
      const double e = std::exp(u);
      sum += e;
      first += e * u;
    });
    to.weights[k] = least - heat * std::log(sum);
    entropy += to.mass[k] * (std::log(sum) - first / sum);
    mass += to.mass[k];
  }
  return entropy / mass;
}

}  // namespace powercell
