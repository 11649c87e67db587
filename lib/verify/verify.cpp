#include <algorithm>
#include <powercell/verify.hpp>

#include "lib/base/text.hpp"
#include "lib/verify/laws.hpp"

namespace powercell {
namespace {

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
  const Rounding rounding(extent_of(domain), seeds, diagram.precision());
  const Cells& cells = diagram.cells();
  const Measures& measures = diagram.measures();

  std::vector<LawCheck> checks{check_partition(measures, cells, &domain.mesh(), rounding),
                               check_statuses(measures, cells, seeds),
                               check_walls(diagram.adjacency(), &domain.mesh(), rounding)};
  for (LawCheck& check : check_pieces(measures, cells, rounding)) checks.push_back(std::move(check));
  checks.push_back(check_bisectors(cells, rounding));
  const std::size_t samples = seeds.size() > 0 ? options.samples : 0;
  checks.push_back(check_owners(random_points(domain.mesh(), samples, options.random_seed), domain.mesh(),
                                cells, rounding));
  return checks;
}

}  // namespace powercell
