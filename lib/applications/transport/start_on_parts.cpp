#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/applications/transport/assignment.hpp"
#include "lib/applications/transport/domain_parts.hpp"
#include "lib/applications/transport/phases.hpp"

namespace powercell {
namespace {

constexpr std::size_t most_parts = 32;          // more are joined
constexpr std::size_t most_shares = 4'000'000;  // seeds times parts; more take too much time and memory
constexpr int rounds = 4;                       // of shares and potentials, which depend on each other
// Every seed takes part in the potential of every part, with this share, and large masses with less than
// their own: their cells are round, not slabs.
constexpr double common_share = 1e-2, mass_power = 0.25;

using Gains = std::vector<std::vector<double>>;
using Shares = Gains;  // part by part, a value for each seed

/// A convex function of the seeds whose gradients are places in the part, (31e): separable along its
/// principal axes; along each axis the gradient is the quantile of the part at the share of the seeds below.
std::vector<double> potential(const DomainPart& part, std::span<const double> positions, std::size_t d,
                              const std::vector<double>& share) {
  const std::size_t n = share.size();
  std::vector<double> value(n);
  double total = 0;
  for (std::size_t i = 0; i < n; ++i) {
    value[i] = part.centroid.dot(place(positions, i, d));
    total += share[i];
  }
  std::vector<std::pair<double, std::uint32_t>> order(n);
  for (int axis = 0; axis < 3; ++axis) {
    for (std::uint32_t i = 0; i < n; ++i) order[i] = {part.axes.row(axis).dot(place(positions, i, d)), i};
    std::sort(order.begin(), order.end());
    double below = 0, sum = 0, last_gradient = 0;
    for (std::size_t k = 0; k < n;) {
      std::size_t end = k;
      double here = 0;  // seeds at one coordinate have one gradient
      for (; end < n && order[end].first == order[k].first; ++end) here += share[order[end].second];
      const double gradient = part.quantiles[static_cast<std::size_t>(axis)].at((below + here / 2) / total);
      if (k > 0) sum += (gradient + last_gradient) / 2 * (order[k].first - order[k - 1].first);
      for (; k < end; ++k) value[order[k].second] += sum;
      below += here;
      last_gradient = gradient;
    }
  }
  return value;
}

/// Weights (31d) from which the cells of each part have about the right masses.
/// \param shares  output: the mass of each seed in each part
Vector weights_on_parts(const std::vector<DomainPart>& parts, std::span<const double> positions,
                        std::size_t d, const Vector& target, Shares& shares) {
  const auto n = static_cast<std::size_t>(target.size());
  const std::vector<double> supply(target.begin(), target.end());
  double measure = 0;
  for (const DomainPart& part : parts) measure += part.measure;
  std::vector<double> room;
  for (const DomainPart& part : parts) room.push_back(part.measure / measure * target.sum());
  Gains gain(parts.size(), std::vector<double>(n));
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (std::size_t i = 0; i < n; ++i) gain[p][i] = parts[p].centroid.dot(place(positions, i, d));
  std::vector<double> price;
  for (int round = 0; round < rounds; ++round) {
    Assignment assignment(gain, supply, room);
    shares = assignment.share();
    price = assignment.prices();
    if (round + 1 == rounds) break;
    Gains next;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      std::vector<double> share(n);
      for (std::size_t i = 0; i < n; ++i)
        share[i] = std::pow(supply[i] / target.mean(), mass_power) *
                   (assignment.share()[p][i] / supply[i] + common_share);
      next.push_back(potential(parts[p], positions, d, share));
    }
    gain = std::move(next);
  }
  Vector weights(target.size());
  for (std::size_t i = 0; i < n; ++i) {
    double best = -std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < parts.size(); ++p) best = std::max(best, gain[p][i] - price[p]);
    weights[static_cast<Eigen::Index>(i)] = place(positions, i, d).squaredNorm() - 2 * best;
  }
  return weights;
}

}  // namespace

void try_on_parts(SolveContext& context, Iterate& best) {
  Evaluator& evaluator = context.evaluator();
  const Vector& target = context.target();
  const Domain& domain = evaluator.diagram().domain();
  const std::size_t parts = std::min(count_parts(domain), most_parts);
  if (parts < 2 || evaluator.density_varies() || parts * evaluator.size() > most_shares) return;
  const auto d = static_cast<std::size_t>(domain.dimension());
  std::vector<DomainPart> at_origin = domain_parts(domain, most_parts);
  std::vector<double> positions(evaluator.positions().begin(), evaluator.positions().end());
  Place middle = Place::Zero();
  for (std::size_t c = 0; c < d; ++c)
    middle[static_cast<Eigen::Index>(c)] = domain.low()[c] / 2 + domain.high()[c] / 2;
  for (std::size_t k = 0; k < positions.size(); ++k) positions[k] -= middle[static_cast<Eigen::Index>(k % d)];
  for (DomainPart& part : at_origin) part.centroid -= middle;
  Shares shares;
  const Vector weights = weights_on_parts(at_origin, positions, d, target, shares);
  if (!weights.allFinite()) return;
  Iterate found = evaluator.evaluate(weights);
  if (found.dual(target) <= best.dual(target)) return;
  best = std::move(found);
  context.set_shares(std::move(shares));
  TransportStep step;
  step.phase = TransportPhase::start;
  context.record(step, best, target);
}

}  // namespace powercell
