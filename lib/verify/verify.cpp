#include <algorithm>
#include <optional>
#include <powercell/verify.hpp>

#include "lib/base/float_environment.hpp"
#include "lib/base/progress.hpp"
#include "lib/base/text.hpp"
#include "lib/verify/laws.hpp"
#include "lib/verify/unfold.hpp"

namespace powercell {
namespace {

void check_same_seeds(const Diagram& diagram, const SeedsView& seeds) {
  if (diagram.has_selection())
    throw Error(ErrorCode::unsupported, "the laws are those of all cells; call select_all() before verify()");
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

/// The box of a domain, and of all cells where they reach beyond it: in a periodic domain.
Extent extent_with(const Domain& domain, const Cells& cells) {
  Extent extent = extent_of(domain);
  const auto d = static_cast<std::size_t>(cells.dimension);
  for (std::size_t at = 0; domain.is_periodic() && at < cells.vertices.size(); ++at) {
    extent.low[at % d] = std::min(extent.low[at % d], cells.vertices[at]);
    extent.high[at % d] = std::max(extent.high[at % d], cells.vertices[at]);
  }
  return extent;
}

}  // namespace

std::vector<LawCheck> verify(Diagram& diagram, const SeedsView& seeds, const VerifyOptions& options) {
  const FloatEnvironment environment;
  check_same_seeds(diagram, seeds);
  const Domain& domain = diagram.domain();
  const RegionMesh& mesh = domain.mesh();
  // Of a periodic diagram the laws are those of the wrapped seeds and the images that they share walls with.
  const std::vector<double> wrapped =
      domain.is_periodic() ? domain.wrapped(seeds.positions) : std::vector<double>();
  const SeedsView places = domain.is_periodic() ? SeedsView{seeds.dimension, wrapped, seeds.weights} : seeds;
  std::optional<Unfolded> unfolded;
  if (domain.is_periodic())
    unfolded = unfold(diagram.measures(), diagram.cells(), seeds, wrapped, *mesh.period);
  const bool solid = domain.is_solid();
  const Cells of_solid = solid ? pieces_of(diagram.joined(), diagram.measures().status) : Cells{};
  const Cells& cells = unfolded ? unfolded->cells : solid ? of_solid : diagram.cells();
  const Measures& measures = unfolded ? unfolded->measures : diagram.measures();
  const Rounding rounding(extent_with(domain, cells), unfolded ? unfolded->seeds() : seeds,
                          diagram.precision());

  std::vector<LawCheck> checks;
  const auto add = [&](LawCheck check) {
    constexpr double most_laws = 7;
    checks.push_back(std::move(check));
    report_progress(options.progress, static_cast<double>(checks.size()), most_laws);
  };
  add(check_partition(measures, cells, &mesh, rounding));
  add(check_statuses(measures, cells, places));
  add(check_walls(diagram.adjacency(), &mesh, rounding));
  for (LawCheck& check : check_pieces(measures, cells, rounding)) add(std::move(check));
  add(check_bisectors(cells, rounding));
  if (solid) {  // without convex pieces whether a point lies in a cell is not simply seen
    add(check_vertices(cells, rounding, options));
    return checks;
  }
  const std::size_t samples = seeds.size() > 0 ? options.samples : 0;
  add(check_owners(random_points(mesh, samples, options.random_seed), mesh, cells, rounding));
  return checks;
}

}  // namespace powercell
