#include "lib/pairs/transpose.hpp"

#include <algorithm>

#include "lib/base/threads.hpp"

namespace powercell::pairs {
namespace {

/// Bounds of `parts` consecutive ranges of regions with about the same number of pairs each.
std::vector<std::size_t> balanced(const std::vector<RankList>& lists, std::uint64_t total,
                                  std::size_t parts) {
  std::vector<std::size_t> bound{0};
  std::uint64_t sum = 0;
  for (std::size_t r = 0; r < lists.size(); ++r) {
    if (sum * parts >= total * bound.size() && bound.size() < parts) bound.push_back(r);
    sum += lists[r].count;
  }
  bound.resize(parts, lists.size());
  bound.push_back(lists.size());
  return bound;
}

}  // namespace

Pairs transpose(const std::vector<RankList>& lists, std::size_t seeds, int threads) {
  std::uint64_t total = 0;
  for (const RankList& list : lists) total += list.count;
  threads = threads_for(total, threads);
  // A counting sort. Each part counts for itself: no more parts than keep the counters linear in the output.
  const std::size_t parts = static_cast<std::size_t>(
      std::clamp<std::uint64_t>(total / std::max<std::size_t>(seeds, 1), 1, static_cast<unsigned>(threads)));
  const std::vector<std::size_t> bound = balanced(lists, total, parts);
  std::vector<std::vector<std::uint64_t>> cursor(parts);
  const auto for_pairs = [&](const auto& body) {
    parallel_for(threads, parts, [&](std::size_t begin, std::size_t end) {
      for (std::size_t part = begin; part < end; ++part) {
        cursor[part].resize(seeds);
        for (std::size_t r = bound[part]; r < bound[part + 1]; ++r)
          for (std::uint32_t k = 0; k < lists[r].count; ++k) body(cursor[part][lists[r].first[k]], r);
      }
    });
  };

  for_pairs([](std::uint64_t& count, std::size_t) { ++count; });
  Pairs pairs;
  pairs.offset.resize(seeds + 1);
  std::uint64_t sum = 0;
  for (std::size_t rank = 0; rank < seeds; ++rank) {
    pairs.offset[rank] = sum;
    for (std::vector<std::uint64_t>& c : cursor) {
      const std::uint64_t count = c[rank];
      c[rank] = sum;
      sum += count;
    }
  }
  pairs.offset[seeds] = sum;
  pairs.region.resize(total);
  // Parts are in ascending order of regions, and so is each part: rows come out ascending.
  for_pairs([&](std::uint64_t& at, std::size_t r) { pairs.region[at++] = static_cast<std::uint32_t>(r); });
  return pairs;
}

}  // namespace powercell::pairs
