#include "tests/device_diagram/weighted.hpp"

#include <algorithm>
#include <cmath>
#include <powercell/diagram.hpp>
#include <powercell/regions.hpp>

namespace powercell::test {

std::vector<double> random_values(const Domain& mesh, Random& random) {
  std::vector<double> values(mesh.regions().vertices.size() / 3);
  for (double& value : values) value = std::max(0.0, random.uniform(-0.67, 2));
  values[random.index(values.size())] = 1;
  return values;
}

std::vector<double> linear_values(const Domain& mesh, double a, const std::array<double, 3>& b) {
  const std::span<const double> x = mesh.regions().vertices;
  std::vector<double> values;
  for (std::size_t v = 0; v < x.size(); v += 3)
    values.push_back(a + b[0] * x[v] + b[1] * x[v + 1] + b[2] * x[v + 2]);
  return values;
}

Output run_with(Caller& caller, DeviceDiagram& diagram, const SeedsView& seeds,
                std::span<const double> values) {
  const Reals memory(caller, diagram.precision(), values);
  diagram.set_density(memory.handle());
  Output found = run(caller, diagram, seeds);
  diagram.set_density(nullptr);
  return found;
}

DensityIntegrals host_integrals(Caller& caller, const Domain& domain, const SeedsView& seeds,
                                std::span<const double> values, Precision precision) {
  Options options;
  options.precision = precision;
  Diagram diagram(caller.device(), domain, options);
  diagram.set_seeds(seeds);
  return integrate(diagram, Density::nodal(values), false);
}

std::size_t differences(const Output& found, const DensityIntegrals& expected, const Domain& domain,
                        double largest, double error) {
  const std::size_t n = found.mass.size();
  double size = 0;
  for (std::size_t k = 0; k < 3; ++k) size = std::max(size, domain.high()[k] - domain.low()[k]);
  const double mean = domain.measure() * largest / static_cast<double>(n);
  std::size_t different = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double mass = expected.mass[i];
    bool right = static_cast<int>(found.status[i]) == static_cast<int>(expected.status[i]) ||
                 (mass <= error * mean && found.mass[i] <= error * mean);
    right = right && std::abs(found.mass[i] - mass) <= error * mean &&
            std::abs(found.second_moment[i] - expected.second_moment[i]) <=
                error * (mean * size * size + expected.second_moment[i]);
    for (std::size_t k = 0; k < 3 && right; ++k) {
      const double a = found.centroid[3 * i + k], b = expected.centroid[3 * i + k];
      right = std::isnan(a) ? !(found.mass[i] > 0)
                            : mass <= error * mean || std::abs(a - b) * mass <= error * mean * size;
    }
    different += !right;
  }
  return different;
}

bool same_row(const Output& a, const Output& b, std::size_t i) {
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  const std::size_t d = a.centroid.size() / a.mass.size();
  bool equal = a.status[i] == b.status[i] && same(a.mass[i], b.mass[i]) &&
               same(a.second_moment[i], b.second_moment[i]);
  for (std::size_t k = 0; k < d; ++k) equal = equal && same(a.centroid[d * i + k], b.centroid[d * i + k]);
  return equal;
}

}  // namespace powercell::test
