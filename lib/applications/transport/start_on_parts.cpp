#include <algorithm>

#include "lib/applications/transport/diagram_evaluator.hpp"
#include "lib/applications/transport/domain_parts.hpp"
#include "lib/applications/transport/domain_points.hpp"
#include "lib/applications/transport/phases.hpp"
#include "lib/applications/transport/soft_start.hpp"

namespace powercell {
namespace {

constexpr double little = 0.05;                 // share of the mass that may be misplaced without a new start
constexpr std::uint32_t most_parts = 32;        // more are joined
constexpr std::size_t least_points = 500;       // by which parts are joined
constexpr std::size_t most_shares = 4'000'000;  // seeds times parts; more take too much time and memory

std::vector<Weighted> points_in_parts(const Domain& domain, const DomainParts& parts, std::size_t count) {
  const auto d = static_cast<std::ptrdiff_t>(domain.dimension());
  const DomainPoints all = domain_points(domain, count);
  std::vector<Weighted> result(parts.count);
  for (std::size_t k = 0; k < all.points.size(); ++k) {
    Weighted& part = result[parts.of_region[all.region[k]]];
    const auto x = all.points.positions.begin() + static_cast<std::ptrdiff_t>(k) * d;
    part.positions.insert(part.positions.end(), x, x + d);
    part.mass.push_back(all.points.mass[k]);
  }
  return result;
}

}  // namespace

void try_on_parts(SolveContext& context, Iterate& best) {
  if (context.evaluator().in_one_place() == nullptr) return;
  DiagramEvaluator& evaluator = *context.evaluator().in_one_place();
  const Vector& target = context.target();
  const Domain& domain = evaluator.domain();
  const bool misplaced = best.gradient(target).lpNorm<1>() / 2 > little * target.sum();
  if (!context.has_several_parts() || evaluator.density_varies() || !misplaced) return;
  DomainParts parts = domain_parts(domain);
  if (std::size_t{std::min(parts.count, most_parts)} * evaluator.size() > most_shares) return;
  join_small(parts, domain_points(domain, least_points), most_parts);
  SoftStart start(
      evaluator.dimension(), [&](std::size_t count) { return points_in_parts(domain, parts, count); },
      evaluator.positions(), {target.data(), evaluator.size()}, evaluator.options().diagram.threads);
  start.solve();
  const Vector weights = start.weights();
  if (!weights.allFinite()) return;
  Iterate found = evaluator.evaluate(weights);
  if (found.dual(target) <= best.dual(target)) return;
  best = std::move(found);
  context.set_shares(start.shares());
  TransportStep step;
  step.phase = TransportPhase::start;
  context.record(step, best, target);
}

}  // namespace powercell
