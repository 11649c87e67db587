#include "lib/applications/treemap/candidate_scan.hpp"

#include "lib/base/compiler.hpp"
#include "lib/base/vector_copies.hpp"

namespace powercell::treemap_detail {

namespace {

constexpr std::size_t lanes = 16;  // seeds per block, two vectors of the widest kind

/// Computes excess[k], which is above 0 if seed k may cut the cell.
/// \return whether any may
POWERCELL_ALWAYS_INLINE bool excesses(std::size_t count, const double* x, const double* y,
                                      const double* weight, const ScanBox& box, double* excess) {
  const double px = box.x, py = box.y, own = box.weight;
  const double low_x = 2 * box.low_x, high_x = 2 * box.high_x, low_y = 2 * box.low_y, high_y = 2 * box.high_y;
  int any = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double qx = x[k] - px, qy = y[k] - py;
    const double at_low_x = qx * low_x, at_high_x = qx * high_x;
    const double at_low_y = qy * low_y, at_high_y = qy * high_y;
    const double reach_x = at_low_x > at_high_x ? at_low_x : at_high_x;
    const double reach_y = at_low_y > at_high_y ? at_low_y : at_high_y;
    excess[k] = reach_x + reach_y - (qx * qx + qy * qy + (own - weight[k]));
    any |= excess[k] > 0 ? 1 : 0;
  }
  return any != 0;
}

}  // namespace

POWERCELL_VECTOR_COPIES std::size_t scan_candidates(std::size_t count, const double* x, const double* y,
                                                    const double* weight, const ScanBox& box,
                                                    std::uint32_t* found) {
  double excess[lanes];
  std::size_t kept = 0, first = 0;
  const auto keep = [&](std::size_t here) {
    for (std::size_t k = 0; k < here; ++k) {
      found[kept] = static_cast<std::uint32_t>(first + k);
      kept += excess[k] > 0 ? 1 : 0;
    }
  };
  for (; first + lanes <= count; first += lanes)
    if (excesses(lanes, x + first, y + first, weight + first, box, excess)) keep(lanes);
  if (first < count && excesses(count - first, x + first, y + first, weight + first, box, excess))
    keep(count - first);
  return kept;
}

}  // namespace powercell::treemap_detail
