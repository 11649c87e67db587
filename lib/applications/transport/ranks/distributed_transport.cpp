#include <bit>
#include <cmath>
#include <powercell/distributed_transport.hpp>
#include <string>

#include "lib/applications/transport/outcome.hpp"
#include "lib/applications/transport/ranks/merging.hpp"
#include "lib/applications/transport/ranks/rank_evaluator.hpp"
#include "lib/applications/transport/ranks/rank_seeds.hpp"
#include "lib/base/float_environment.hpp"
#include "lib/base/mailbox.hpp"

namespace powercell {
namespace {

constexpr double default_tolerance = 1e-6;

[[noreturn]] void refuse(const std::string& what, ErrorCode code = ErrorCode::invalid_argument) {
  throw Error(code, what);
}

void require_supported(const TransportOptions& options, const Domain& domain) {
  if (!options.density.is_constant())
    refuse("a transport over ranks needs a constant density", ErrorCode::unsupported);
  if (options.periodic || domain.is_periodic())
    refuse("a transport over ranks needs a domain that is not periodic", ErrorCode::unsupported);
  if (options.linear != LinearSolver::automatic)
    refuse(
        "a transport over ranks has its linear solver from the caller; leave TransportOptions::linear "
        "automatic");
}

void require_same_call(const TransportOptions& options, double total, Mailbox& mailbox) {
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  require_same({{"the mass of the domain", bits(total)},
                {"TransportOptions::tolerance", bits(options.tolerance)},
                {"TransportOptions::max_steps", static_cast<std::uint64_t>(options.max_steps)},
                {"TransportOptions::linear_residual", bits(options.linear_residual)},
                {"TransportOptions::rescale", options.rescale ? 1U : 0U}},
               mailbox);
}

/// What would not come as far as compute_distributed, which refuses the rest.
void require_valid_seeds(const SeedsView& seeds, int dimension, std::uint64_t first) {
  const std::size_t n = seeds.size();
  if (seeds.dimension != dimension)
    refuse("seeds of dimension " + std::to_string(seeds.dimension) + " in a domain of dimension " +
           std::to_string(dimension));
  if (n * static_cast<std::size_t>(dimension) != seeds.positions.size())
    refuse(std::to_string(seeds.positions.size()) + " coordinates are not a multiple of the dimension");
  if (!seeds.weights.empty() && seeds.weights.size() != n)
    refuse(std::to_string(seeds.weights.size()) + " weights for " + std::to_string(n) + " seeds");
  const auto bad = [&](std::size_t i, const char* what) {
    refuse("seed " + std::to_string(first + i) + ": " + what + " is not finite", ErrorCode::invalid_seed);
  };
  for (std::size_t k = 0; k < seeds.positions.size(); ++k)
    if (!std::isfinite(seeds.positions[k])) bad(k / static_cast<std::size_t>(dimension), "a coordinate");
  for (std::size_t i = 0; i < seeds.weights.size(); ++i)
    if (!std::isfinite(seeds.weights[i])) bad(i, "the weight");
}

/// The seeds and masses of this rank.
struct Given {
  const SeedsView& seeds;
  std::span<const double> masses;
};

TransportResult solve(const OnRanks& ranks, const Device& device, const Domain& domain, const Given& given,
                      const DistributedTransportOptions& options) {
  const TransportOptions& transport = options.transport;
  const std::size_t n = given.seeds.size(), d = static_cast<std::size_t>(domain.dimension());
  const std::uint64_t first = ranks.numbers.first();
  require_valid(transport);
  require_supported(transport, domain);
  require_valid_seeds(given.seeds, domain.dimension(), first);
  require_valid_masses(given.masses, n, first);
  if (ranks.numbers.total() == 0) refuse("no seeds: a transport needs at least one");
  if (ranks.all.any(!given.masses.empty()) && given.masses.size() != n)
    refuse("0 masses for " + std::to_string(n) + " seeds, while other ranks give masses");

  TransportResult result;
  result.total_mass = domain_mass(transport, domain);
  require_same_call(transport, result.total_mass, ranks.mailbox);
  result.target = target_masses(given.masses, n, result.total_mass, transport.rescale, ranks.all, first);
  result.tolerance = transport.tolerance > 0 ? transport.tolerance : default_tolerance;

  const Merging merging(given.seeds.positions, d, ranks.numbers, ranks.mailbox);
  const std::vector<std::uint32_t>& kept = merging.kept();
  result.merged = ranks.all.count(n - kept.size());
  const std::vector<double> positions = rows(given.seeds.positions, kept, d);
  Vector weights = Vector::Zero(static_cast<Eigen::Index>(kept.size()));
  if (!given.seeds.weights.empty()) weights = vector_of(rows(given.seeds.weights, kept, 1));
  RankEvaluator cells(ranks, device, domain, result.total_mass / domain.measure(), kept, positions, options);
  const Iterate at = solve_and_report(cells, transport, transport.tolerance > 0,
                                      vector_of(merging.joined(result.target)), weights, result);
  fill_arrays(at, kept, n, d, result);
  merging.spread(result.weights);
  return result;
}

}  // namespace

DistributedLinearSolver::~DistributedLinearSolver() = default;

TransportResult transport_distributed(Communicator& communicator, DistributedLinearSolver& solver,
                                      const Device& device, const Domain& domain, const SeedsView& seeds,
                                      std::span<const double> masses,
                                      const DistributedTransportOptions& options) {
  const FloatEnvironment environment;
  RankMailbox mailbox(communicator);
  return mailbox.together([&] {
    const RankSeeds all(mailbox);
    const Numbering numbers(mailbox, seeds.size());
    return solve({communicator, solver, mailbox, all, numbers}, device, domain, {seeds, masses}, options);
  });
}

}  // namespace powercell
