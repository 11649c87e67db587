#include "tests/fuzz/device_density.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <powercell/density.hpp>
#include <powercell/regions.hpp>

#include "tests/fuzz/laws.hpp"
#include "tests/fuzz/refusals.hpp"

namespace powercell::fuzz {
namespace {

/// Values as they come, or without their signs, or all the same.
template <class Real>
std::vector<Real> any_values(Input& input, std::size_t count) {
  const std::size_t kind = input.below(4);
  std::vector<double> values = kind == 3 ? std::vector<double>(count, input.number()) : input.numbers(count);
  if (kind != 0)
    for (double& value : values) value = std::fabs(value);
  return {values.begin(), values.end()};
}

template <class Real>
bool is_density(const std::vector<Real>& values) {
  const Real largest = static_cast<Real>(sizeof(Real) == 4 ? 1e30 : Density::largest_value);
  return std::all_of(values.begin(), values.end(), [=](Real v) { return v >= 0 && v <= largest; }) &&
         std::any_of(values.begin(), values.end(), [](Real v) { return v > 0; });
}

/// Whether products of values with measures and second moments neither overflow nor lose digits.
template <class Real>
bool fits(double largest_value, const Domain& domain) {
  double size = 0;
  for (std::size_t k = 0; k < 3; ++k) size = std::max(size, domain.high()[k] - domain.low()[k]);
  const double mass = largest_value * domain.measure(), range = std::numeric_limits<Real>::max() / 1e6;
  return mass < range && mass * size * size < range && mass > 1e6 / range && mass * size * size > 1e6 / range;
}

/// A mass where there is a cell, and NaN only if the cell or, unless they are `good`, the values have none.
void check_status(double mass, cl_uint status, bool good, const std::string& seed) {
  switch (static_cast<DeviceSeedStatus>(status)) {
    case DeviceSeedStatus::ok:
      require(std::isnan(mass) ? !good : mass >= 0, seed + "a mass that cannot be");
      break;
    case DeviceSeedStatus::hidden:
    case DeviceSeedStatus::duplicate:
      require(mass == 0, seed + "a mass without a cell");
      break;
    default:
      require(std::isnan(mass), seed + "the mass of a cell that is not known");
  }
}

}  // namespace

ExactTwin::ExactTwin(const Domain& domain, const Options& options, const SeedInput& given,
                     const std::vector<cl_uint>& status)
    : diagram(caller_device(), domain, options) {
  const auto d = static_cast<std::size_t>(domain.dimension());
  for (cl_uint i = 0; i < status.size(); ++i) {
    if (status[i] == static_cast<cl_uint>(DeviceSeedStatus::invalid)) continue;
    number.push_back(i);
    valid.weights.push_back(given.weights[i]);
    for (std::size_t k = 0; k < d; ++k) valid.positions.push_back(given.positions[i * d + k]);
  }
  diagram.set_seeds({domain.dimension(), valid.positions, valid.weights});
}

double ExactTwin::mass_doubt(Precision precision) const {
  const Domain& domain = diagram.domain();
  const SeedsView view{domain.dimension(), valid.positions, valid.weights};
  return (precision == Precision::float32 ? 1e-5 : 1e-12) +
         8 * sum_doubt(domain, number.size(), plane_error(domain, view, precision));
}

template <class Real>
void check_density(Input& input, DeviceDiagram& diagram, const DeviceSeeds& seeds,
                   const std::vector<cl_uint>& status, ExactTwin& twin) {
  if (!input.flag()) return;
  const Domain& domain = diagram.domain();
  const bool mesh =
      domain.kind() == DomainKind::surface || domain.regions().shape == RegionShape::tetrahedron;
  const auto values = any_values<Real>(input, mesh ? domain.regions().vertices.size() / 3 : 1);
  const Memory memory(values.size() * sizeof(Real), values.data());
  if (!mesh) {
    try {
      diagram.set_density(memory.handle);
    } catch (const Error& error) {
      require(error.code() == ErrorCode::unsupported, error.what());
      return;
    }
    throw Finding("a density on a domain without a mesh");
  }

  const std::size_t n = status.size(), d = static_cast<std::size_t>(domain.dimension());
  const Memory measures(n * (2 + d) * sizeof(Real)), statuses(n * sizeof(cl_uint)), count(sizeof(cl_uint)),
      list(n * sizeof(cl_uint));
  const DeviceResults results{measures.handle, statuses.handle, {}, {count.handle, list.handle}, {}, {}};
  diagram.set_density(memory.handle);
  diagram.enqueue(seeds.positions.handle, seeds.weights.handle, seeds.count, results);
  require(read<cl_uint>(statuses, n) == status, "statuses differ with a density");
  const auto before = read<Real>(measures, n * (2 + d));
  const bool good = is_density(values);
  const double largest = good ? *std::max_element(values.begin(), values.end()) : 0;
  const bool comparable = good && fits<Real>(largest, domain);
  for (std::size_t i = 0; i < n; ++i)
    check_status(before[i * (2 + d)], status[i], comparable, "seed " + std::to_string(i) + ": ");

  diagram.repair(seeds.positions.handle, seeds.weights.handle, seeds.count, results);
  const double allowed = twin.mass_doubt(diagram.precision());
  if (!comparable || twin.number.empty() || allowed >= 0.01) return;
  const auto after = read<Real>(measures, n * (2 + d));
  const std::vector<double> wide(values.begin(), values.end());
  const DensityIntegrals exact = integrate(twin.diagram, Density::nodal(wide), false);
  for (std::size_t k = 0; k < twin.number.size(); ++k) {
    const double mass = after[twin.number[k] * (2 + d)];
    require(std::fabs(mass - exact.mass[k]) <= allowed * largest * domain.measure(),
            "repaired seed " + std::to_string(twin.number[k]) + ": a mass of " + std::to_string(mass) +
                " in place of " + std::to_string(exact.mass[k]));
  }
}

template void check_density<float>(Input&, DeviceDiagram&, const DeviceSeeds&, const std::vector<cl_uint>&,
                                   ExactTwin&);
template void check_density<double>(Input&, DeviceDiagram&, const DeviceSeeds&, const std::vector<cl_uint>&,
                                    ExactTwin&);

}  // namespace powercell::fuzz
