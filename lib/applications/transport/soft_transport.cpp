#include "lib/applications/transport/soft_transport.hpp"

#include <cmath>
#include <cstdint>
#include <numeric>

#include "lib/applications/transport/power_tree.hpp"
#include "lib/base/threads.hpp"

namespace powercell {

double soften(const Weighted& from, Weighted& to, std::size_t d, double heat, int threads, double cut) {
  std::vector<double> raised(from.size());
  const double total = std::accumulate(from.mass.begin(), from.mass.end(), 0.0);
  for (std::size_t i = 0; i < raised.size(); ++i)
    raised[i] = from.weights[i] + heat * std::log(from.mass[i] / total);
  std::vector<std::uint32_t> all(from.size());
  std::iota(all.begin(), all.end(), 0U);
  const PowerTree tree(from.positions, raised, d, std::move(all));
  std::vector<double> entropy(to.size());
  parallel_for(threads_for(to.size(), threads, 2048), to.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
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
      entropy[k] = std::log(sum) - first / sum;
    }
  });
  return std::inner_product(entropy.begin(), entropy.end(), to.mass.begin(), 0.0) /
         std::accumulate(to.mass.begin(), to.mass.end(), 0.0);
}

}  // namespace powercell
