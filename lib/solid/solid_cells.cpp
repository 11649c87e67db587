#include "lib/solid/solid_cells.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "kernels/layout.h"
#include "lib/base/progress.hpp"
#include "lib/clip/in_chunks.hpp"
#include "lib/solid/solid_chunk.hpp"

namespace powercell {
namespace {

constexpr std::uint64_t least_chunk_pairs = 1024;

/// Per triangle whether only one seed can meet it, so that it lies in that cell as a whole.
std::vector<bool> triangles_of_one(const Pairs& pairs, std::size_t triangles) {
  std::vector<bool> seen(triangles), alone(triangles);
  for (const std::uint32_t t : pairs.region) {
    alone[t] = !seen[t];
    seen[t] = true;
  }
  return alone;
}

}  // namespace

SolidCells compute_solid_cells(const SolidCellsInput& input, SolidMemory& memory,
                               ClipStatistics& statistics) {
  const std::size_t seeds = input.scene.seeds.size();
  const Scene facets{input.boundary.on_device, input.scene.buffers, input.scene.seeds, input.scene.tree};
  std::vector<bool> excluded(seeds);
  for (const std::uint32_t rank : input.excluded) excluded[rank] = true;
  std::vector<std::uint32_t> ranks;  // that have pairs
  for (std::uint32_t rank = 0; rank < seeds; ++rank)
    if (!excluded[rank] && input.pairs.offset[rank + 1] > input.pairs.offset[rank]) ranks.push_back(rank);
  const std::vector<bool> alone = triangles_of_one(input.pairs, input.boundary.mesh.region_count());
  SolidCells all;
  all.hints.seen.resize(seeds);
  std::optional<Clipper> clipper;
  std::vector<std::uint64_t> first_pair{0};  // of each rank that has some
  for (const std::uint32_t rank : ranks)
    first_pair.push_back(first_pair.back() + input.pairs.offset[rank + 1] - input.pairs.offset[rank]);
  const auto rank_from = [&](std::uint64_t pair) {
    return static_cast<std::size_t>(std::lower_bound(first_pair.begin(), first_pair.end(), pair) -
                                    first_pair.begin());
  };
  in_chunks(
      first_pair.back(), {input.chunk_pairs, least_chunk_pairs, "pairs"},
      [&](std::uint64_t first, std::uint64_t last) {
        const std::size_t begin = rank_from(first), end = rank_from(last);
        if (begin == end) return;
        if (!clipper)
          clipper.emplace(facets, input.on_facets, OUTPUT_MOMENTS | OUTPUT_GEOMETRY,
                          ClipOptions{true, input.threads, true}, std::exchange(memory.facets, {}));
        solid::Chunk chunk(input, alone, std::span(ranks).subspan(begin, end - begin));
        chunk.clip_facets(*clipper);
        chunk.clip_cells(memory.cells, statistics, all.hints);
        chunk.append_to(all);
        report_progress(input.progress, static_cast<double>(end), static_cast<double>(ranks.size()));
      },
      [&] {
        clipper.reset();
        memory = {};
      });
  std::sort(all.unclear.begin(), all.unclear.end());
  if (!clipper) return all;
  statistics.add(clipper->statistics());
  memory.facets = std::move(*clipper).release();
  return all;
}

}  // namespace powercell
