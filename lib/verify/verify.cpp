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
  if (diagram.domain().is_periodic())
    throw Error(
        ErrorCode::unsupported,
        "the laws of a periodic diagram cannot be checked here; Options::certify checks those that hold in "
        "a periodic domain");
  const Domain& domain = diagram.domain();
  const Rounding rounding(extent_of(domain), seeds, diagram.precision());
  const bool solid = domain.is_solid();
  const Cells of_solid = solid ? pieces_of(diagram.joined(), diagram.measures().status) : Cells{};
  const Cells& cells = solid ? of_solid : diagram.cells();
  const Measures& measures = diagram.measures();

  std::vector<LawCheck> checks;
  const auto add = [&](LawCheck check) {
    constexpr double most_laws = 7;
    checks.push_back(std::move(check));
    if (options.progress && !options.progress(static_cast<double>(checks.size()) / most_laws))
      throw Error(ErrorCode::interrupted, "stopped by the progress callback while checking laws");
  };
  add(check_partition(measures, cells, &domain.mesh(), rounding));
  add(check_statuses(measures, cells, seeds));
  add(check_walls(diagram.adjacency(), &domain.mesh(), rounding));
  for (LawCheck& check : check_pieces(measures, cells, rounding)) add(std::move(check));
  add(check_bisectors(cells, rounding));
  if (solid) {  // without convex pieces whether a point lies in a cell is not simply seen
    add(check_vertices(cells, rounding, options));
    return checks;
  }
  const std::size_t samples = seeds.size() > 0 ? options.samples : 0;
  add(check_owners(random_points(domain.mesh(), samples, options.random_seed), domain.mesh(), cells,
                   rounding));
  return checks;
}

}  // namespace powercell
