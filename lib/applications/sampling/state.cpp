#include "lib/applications/sampling/state.hpp"

#include <algorithm>
#include <cmath>
#include <powercell/point_sets.hpp>

#include "lib/applications/sampling/apart.hpp"
#include "lib/applications/sampling/nearest.hpp"
#include "lib/applications/sampling/solid_cells.hpp"
#include "lib/applications/transport/periodic_domain.hpp"

namespace powercell {
namespace {

TransportOptions transport_options(const SamplingOptions& options) {
  TransportOptions result;
  result.density = options.density;
  result.periodic = options.periodic;
  result.diagram = options.diagram;
  return result;
}

}  // namespace

SamplingState::SamplingState(const Device& device, const Domain& domain, const SamplingOptions& options,
                             std::vector<double> positions)
    : device_(device),
      domain_(periodic_domain(domain, options.periodic)),
      options_(options),
      dimension_(static_cast<std::size_t>(domain.dimension())),
      positions_(std::move(positions)),
      solver_(device, domain, transport_options(options)) {
  solver_.set_seeds({domain.dimension(), positions_, {}});
}

void SamplingState::restart(std::vector<double> positions) {
  positions_ = std::move(positions);
  solver_.set_seeds({domain_.dimension(), positions_, {}});
}

void SamplingState::move_to(std::vector<double> positions, double tolerance, int max_steps) {
  solver_.move_seeds(positions);
  positions_ = std::move(positions);
  solver_.set_tolerance(tolerance);
  solver_.set_max_steps(max_steps);
  solver_.solve();
}

std::vector<double> SamplingState::centroids() const {
  std::vector<double> result = cells().centroid;
  for (std::size_t k = 0; k < result.size(); ++k)
    if (!(cells().mass[k / dimension_] > 0)) result[k] = positions_[k];
  return result;
}

std::vector<double> SamplingState::energy_gradient() const {
  std::vector<double> result = centroids();
  for (std::size_t k = 0; k < result.size(); ++k)
    result[k] = 2 * cells().mass[k / dimension_] * (positions_[k] - result[k]);
  return result;
}

double SamplingState::distance_to_centroids() const {
  const std::vector<double> to = centroids();
  double sum = 0;
  for (std::size_t k = 0; k < to.size(); ++k) sum += (to[k] - positions_[k]) * (to[k] - positions_[k]);
  return std::sqrt(sum / static_cast<double>(size()));
}

NeighbourStatistics SamplingState::neighbour_statistics() const {
  return powercell::neighbour_statistics(device_, domain_, wrapped(), options_.periodic, true,
                                         options_.diagram);
}

double SamplingState::capacity_error() const {
  const double capacity = cells().total_mass / static_cast<double>(size());
  double worst = 0;
  for (const double mass : cells().mass) worst = std::max(worst, std::abs(mass / capacity - 1));
  return worst;
}

std::vector<double> SamplingState::wrapped() const {
  return domain_.wrapped(positions_);
}

std::vector<double> SamplingState::in_domain(bool at_centroids) {
  std::vector<double> result = positions_;
  // The cells of a convex domain are convex and contain their centroids.
  if (domain_.is_periodic() || (at_centroids && domain_.region_count() == 1)) return result;
  const auto project = [&](const auto& geometry, const auto& offset) {
    for (std::size_t i = 0; i < size(); ++i) {
      if (offset[i] == offset[i + 1]) continue;
      std::array<double, 3> x{};
      std::copy_n(&positions_[i * dimension_], dimension_, x.begin());
      x = nearest_in_cell(geometry, i, x);
      std::copy_n(x.begin(), dimension_, &result[i * dimension_]);
    }
  };
  if (domain_.is_solid()) {
    const JoinedCells& geometry = solver_.diagram().joined();
    project(geometry, geometry.face_offset);
  } else {
    const Cells& geometry = solver_.diagram().cells();
    project(geometry, geometry.cell_offset);
  }
  return result;
}

double SamplingState::relative_energy() {
  const int d = domain_.cell_dimension();
  // kappa of (38): the energy of a cell of the hexagonal or body-centred cubic lattice, over mass and
  // measure^(2/d).
  const double lattice = d == 2 ? 5 / (18 * std::sqrt(3.0)) : 3 * 19 / (192 * std::cbrt(2.0));
  double sum = 0;
  if (options_.density.is_constant()) {
    const auto n = static_cast<double>(size());
    sum = cells().total_mass * std::pow(domain_.measure() / n, 2.0 / d);
  } else {
    const Measures& measures = solver_.diagram().measures();
    for (std::size_t i = 0; i < size(); ++i) sum += cells().mass[i] * std::pow(measures.mass[i], 2.0 / d);
  }
  return cells().primal / (lattice * sum);
}

PartsApart SamplingState::parts_apart() {
  // The cells of a convex domain are convex.
  if (options_.periodic || domain_.region_count() == 1) return {};
  Diagram& diagram = solver_.diagram();
  return domain_.is_solid() ? powercell::parts_apart(diagram.joined(), positions_)
                            : powercell::parts_apart(diagram.cells(), positions_);
}

}  // namespace powercell
