#include <algorithm>
#include <powercell/verify.hpp>

#include "lib/base/text.hpp"
#include "lib/verify/laws.hpp"
#include "lib/verify/partition.hpp"

namespace powercell {
namespace {

/// Masses are sums over cells whose shared faces move alike, so the error of the total does not grow with
/// their number.
constexpr double partition_double = 1e-12, partition_float = 1e-5;

LawCheck check_partition(const Measures& measures, const Cells& cells, const RegionMesh& mesh,
                         const Rounding& rounding, Precision precision) {
  double reach = 0;
  for (std::size_t i = 0; i < measures.mass.size(); ++i)
    if (measures.status[i] == SeedStatus::ok) reach = std::max(reach, rounding.reach(i));
  const double usual = precision == Precision::float32 ? partition_float : partition_double;
  double tolerance = partition_tolerance(mesh, usual, reach);
  const bool covered = !measures.mass.empty();  // no seeds have no cells
  const double error = covered ? measures.relative_error() : 0;
  if (error > tolerance)
    tolerance += static_cast<double>(slanted_area(cells, mesh, rounding)) / measures.domain_measure;
  LawCheck check{
      "partition: the measures sum to the domain's (relative)", error <= tolerance, error, tolerance, {}};
  if (!check.passed)
    check.detail = "the cells sum to " + digits(measures.total()) + ", the domain has " +
                   digits(measures.domain_measure);
  return check;
}

void check_same_seeds(const Diagram& diagram, const SeedsView& seeds) {
  const bool same = seeds.dimension == diagram.domain().dimension() && seeds.size() == diagram.size();
  const std::size_t coordinates = seeds.positions.size(), weights = seeds.weights.size();
  if (same && coordinates == seeds.size() * static_cast<std::size_t>(seeds.dimension) &&
      (weights == 0 || weights == seeds.size()))
    return;
  if (same)
    throw Error(ErrorCode::invalid_argument,
                std::to_string(coordinates) + " coordinates and " + std::to_string(weights) +
                    " weights were given for " + std::to_string(seeds.size()) + " seeds in " +
                    std::to_string(seeds.dimension) +
                    "D: give all coordinates, and one weight for each seed or none for all zero");
  throw Error(ErrorCode::invalid_argument,
              std::to_string(seeds.size()) + " seeds in " + std::to_string(seeds.dimension) +
                  "D were given to check a diagram of " + std::to_string(diagram.size()) + " seeds in " +
                  std::to_string(diagram.domain().dimension()) + "D: give the seeds that the diagram has");
}

}  // namespace

std::vector<LawCheck> verify(Diagram& diagram, const SeedsView& seeds, const VerifyOptions& options) {
  check_same_seeds(diagram, seeds);
  const Domain& domain = diagram.domain();
  const Rounding rounding(domain, seeds, diagram.precision());
  const Cells& cells = diagram.cells();
  const Measures& measures = diagram.measures();

  std::vector<LawCheck> checks;
  checks.push_back(check_partition(measures, cells, domain.mesh(), rounding, diagram.precision()));
  checks.push_back(check_statuses(measures, cells, seeds));
  checks.push_back(check_walls(diagram.adjacency(), domain, rounding));
  for (LawCheck& check : check_pieces(measures, cells, rounding)) checks.push_back(std::move(check));
  const std::size_t samples = seeds.size() > 0 ? options.samples : 0;
  checks.push_back(check_owners(random_points(domain.mesh(), samples, options.random_seed), domain.mesh(),
                                cells, rounding));
  return checks;
}

}  // namespace powercell
