#include "lib/diagram/clip_chunk.hpp"

#include <algorithm>

namespace powercell {

void ClipChunk::set_pairs(const Plan& plan, std::uint64_t first, std::uint64_t last) {
  const std::vector<std::uint64_t>& offset = plan.pairs.offset;
  const auto row_of = [&](std::uint64_t pair) {
    return static_cast<std::uint32_t>(std::upper_bound(offset.begin(), offset.end(), pair) - offset.begin() -
                                      1);
  };
  begin = first;
  end = last;
  pair_row.resize(end - begin);
  for (std::uint32_t row = row_of(begin); row <= row_of(end - 1); ++row) {
    const std::uint64_t from = std::max(begin, offset[row]), to = std::min(end, offset[row + 1]);
    if (to > from) std::fill_n(&pair_row[from - begin], to - from, row);
  }
  set_seeds(plan);
  pair_region = std::span(plan.pairs.region).subspan(begin, end - begin);
}

void ClipChunk::set_seeds(const Plan& plan) {
  pair_seed = pair_row;
  if (!plan.selected) return;
  selected_seed.resize(pair_row.size());
  std::transform(pair_row.begin(), pair_row.end(), selected_seed.begin(),
                 [&](std::uint32_t row) { return plan.selected->rank[row]; });
  pair_seed = selected_seed;
}

}  // namespace powercell
