#include <algorithm>
#include <numeric>

#include "lib/base/text.hpp"
#include "lib/verify/laws.hpp"

namespace powercell {
namespace {

/// Seeds grouped by position; within a group by descending weight, then by index.
std::vector<std::uint32_t> by_position(const SeedsView& seeds) {
  const auto d = static_cast<std::size_t>(seeds.dimension);
  std::vector<std::uint32_t> order(seeds.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    for (std::size_t k = 0; k < d; ++k) {
      const double x = seeds.positions[a * d + k], y = seeds.positions[b * d + k];
      if (x != y) return x < y;
    }
    const double wa = seeds.weights.empty() ? 0 : seeds.weights[a],
                 wb = seeds.weights.empty() ? 0 : seeds.weights[b];
    return wa != wb ? wa > wb : a < b;
  });
  return order;
}

bool same_position(const SeedsView& seeds, std::uint32_t a, std::uint32_t b) {
  const auto d = static_cast<std::size_t>(seeds.dimension);
  return std::equal(&seeds.positions[a * d], &seeds.positions[a * d] + d, &seeds.positions[b * d]);
}

std::string fault_of(SeedStatus status, bool twin, double mass, std::uint64_t pieces) {
  if (twin != (status == SeedStatus::duplicate))
    return twin ? "shares its position with a seed that comes first but is not marked duplicate"
                : "is marked duplicate, but no seed at its position comes first";
  const bool ok = status == SeedStatus::ok;
  if (ok != (mass > 0)) return (ok ? "is ok with measure " : "is not ok with measure ") + digits(mass);
  if (ok != (pieces > 0))
    return (ok ? "is ok with " : "is not ok with ") + std::to_string(pieces) + " pieces";
  return {};
}

}  // namespace

LawCheck check_statuses(const Measures& measures, const Cells& cells, const SeedsView& seeds) {
  const std::vector<std::uint32_t> order = by_position(seeds);
  std::size_t faults = 0;
  std::string detail;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::uint32_t i = order[k];
    const bool twin = k > 0 && same_position(seeds, order[k - 1], i);
    const std::string fault =
        fault_of(measures.status[i], twin, measures.mass[i], cells.cell_offset[i + 1] - cells.cell_offset[i]);
    if (fault.empty()) continue;
    if (faults++ == 0) detail = "seed " + std::to_string(i) + " " + fault;
  }
  if (faults > 1) detail += "; " + std::to_string(faults) + " seeds in all";
  return {"statuses: ok with a cell, hidden and duplicate without", faults == 0, static_cast<double>(faults),
          0, detail};
}

}  // namespace powercell
