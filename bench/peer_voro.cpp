#include <algorithm>
#include <cmath>
#include <voro++/voro++.hh>

#include "bench/box_cell.hpp"
#include "bench/peers.hpp"

namespace powercell::bench {

double cell_volume_in_box(const SeedsView& seeds, std::size_t i, std::span<const std::uint32_t> neighbors,
                          const test::Box& box) {
  const double* p = &seeds.positions[3 * i];
  voro::voronoicell cell;
  cell.init(box.low[0] - p[0], box.high[0] - p[0], box.low[1] - p[1], box.high[1] - p[1], box.low[2] - p[2],
            box.high[2] - p[2]);
  for (const std::uint32_t j : neighbors) {
    const double* other = &seeds.positions[3 * static_cast<std::size_t>(j)];
    const double x = other[0] - p[0], y = other[1] - p[1], z = other[2] - p[2];
    if (!cell.nplane(x, y, z, x * x + y * y + z * z + seeds.weights[i] - seeds.weights[j], 0)) return 0;
  }
  return cell.volume();
}

std::vector<double> voro_measures(const SeedsView& seeds, const Box& box) {
  const std::size_t n = seeds.size();
  constexpr double seeds_per_block = 5;
  const int blocks = std::max(1, static_cast<int>(std::cbrt(static_cast<double>(n) / seeds_per_block)));
  voro::container_poly container(box.low[0], box.high[0], box.low[1], box.high[1], box.low[2], box.high[2],
                                 blocks, blocks, blocks, false, false, false, 8);
  const double least = *std::min_element(seeds.weights.begin(), seeds.weights.end());
  for (std::size_t i = 0; i < n; ++i) {
    const double* p = &seeds.positions[3 * i];
    container.put(static_cast<int>(i), p[0], p[1], p[2], std::sqrt(seeds.weights[i] - least));
  }
  std::vector<double> measures(n, 0.0);
  voro::voronoicell cell;
  voro::c_loop_all loop(container);
  if (loop.start()) do
      if (container.compute_cell(cell, loop)) measures[static_cast<std::size_t>(loop.pid())] = cell.volume();
    while (loop.inc());
  return measures;
}

}  // namespace powercell::bench
