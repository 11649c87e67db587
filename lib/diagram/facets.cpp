#include "lib/diagram/facets.hpp"

#include <algorithm>
#include <optional>

#include "kernels/layout.h"
#include "lib/base/progress.hpp"
#include "lib/clip/in_chunks.hpp"
#include "lib/collect/facets.hpp"
#include "lib/diagram/chunk_pipeline.hpp"

namespace powercell {
namespace {

/// The pairs whose regions have facets of the boundary.
struct FacetPairs {
  std::vector<std::uint32_t> row, seed, region;
};

std::vector<bool> regions_at_boundary(const RegionMesh& mesh) {
  std::vector<bool> at_boundary(mesh.region_count());
  for (std::size_t r = 0; r < at_boundary.size(); ++r)
    at_boundary[r] =
        std::any_of(mesh.facet.begin() + mesh.facet_offset[r], mesh.facet.begin() + mesh.facet_offset[r + 1],
                    [](const Border& b) { return b.kind == Border::Kind::boundary; });
  return at_boundary;
}

FacetPairs pairs_at_boundary(const RegionMesh& mesh, const ClipPlan& plan) {
  const std::vector<bool> at_boundary = regions_at_boundary(mesh);
  FacetPairs pairs;
  for (std::uint32_t row = 0; row + 1 < plan.pairs.offset.size(); ++row)
    for (std::uint64_t p = plan.pairs.offset[row]; p < plan.pairs.offset[row + 1]; ++p) {
      if (!at_boundary[plan.pairs.region[p]]) continue;
      pairs.row.push_back(row);
      pairs.seed.push_back(plan.selected ? plan.selected->rank[row] : row);
      pairs.region.push_back(plan.pairs.region[p]);
    }
  return pairs;
}

}  // namespace

BoundaryWalls clip_facets(const DiagramSetup& setup, const ActiveSeeds& active, const ClipPlan& plan,
                          const std::vector<SeedStatus>& status) {
  const FacetPairs pairs = pairs_at_boundary(setup.domain.mesh(), plan);
  const std::uint64_t total = pairs.row.size();
  FacetCollector facets(setup.domain.mesh());
  std::optional<Clipper> clipper;
  const std::function<bool(double)>& progress = setup.options.progress;
  if (total > 0)
    in_chunks(
        total, {chunk_pairs(setup, setup.members.front(), total), least_chunk_pairs, "pairs"},
        [&](std::uint64_t begin, std::uint64_t end) {
          if (!clipper)
            clipper.emplace(active.scene(), *plan.candidates, OUTPUT_MOMENTS | OUTPUT_WALLS | OUTPUT_FACETS,
                            ClipOptions{.exact = setup.options.decisions == Decisions::exact,
                                        .threads = setup.threads,
                                        .pairs = total});
          const auto chunk = [&](const std::vector<std::uint32_t>& all) {
            return std::span(all).subspan(begin, end - begin);
          };
          facets.add(chunk(pairs.row), chunk(pairs.region),
                     clipper->clip(chunk(pairs.seed), chunk(pairs.region)));
          report_progress(progress, static_cast<double>(end), static_cast<double>(total));
        },
        [&] { clipper.reset(); });
  const SeedSet& rows = plan.selected ? plan.selected->seeds : active.seeds();
  return facets.finish(rows.input, status, setup.on_device.frame().unit(setup.domain.cell_dimension() - 1));
}

}  // namespace powercell
