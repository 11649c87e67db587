#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <thread>
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

namespace {

/// A container with blocks of about five seeds, as voro++'s documentation advises. Radii are square roots of
/// weights.
std::unique_ptr<voro::container_poly> fill_container(const SeedsView& seeds, const Box& box) {
  constexpr double seeds_per_block = 5;
  const std::size_t n = seeds.size();
  const int blocks = std::max(1, static_cast<int>(std::cbrt(static_cast<double>(n) / seeds_per_block)));
  auto container =
      std::make_unique<voro::container_poly>(box.low[0], box.high[0], box.low[1], box.high[1], box.low[2],
                                             box.high[2], blocks, blocks, blocks, false, false, false, 8);
  const double least = *std::min_element(seeds.weights.begin(), seeds.weights.end());
  for (std::size_t i = 0; i < n; ++i) {
    const double* p = &seeds.positions[3 * i];
    container->put(static_cast<int>(i), p[0], p[1], p[2], std::sqrt(seeds.weights[i] - least));
  }
  return container;
}

/// Measures the cells of one row of blocks after the other, taken from `next_row`.
void measure_rows(const SeedsView& seeds, const Box& box, std::atomic<int>& next_row,
                  std::vector<double>& measures) {
  const auto container = fill_container(seeds, box);
  voro::voronoicell cell;
  const int rows = container->ny * container->nz;
  for (int row = next_row++; row < rows; row = next_row++)
    for (int block = row * container->nx; block < (row + 1) * container->nx; ++block)
      for (int k = 0; k < container->co[block]; ++k)
        if (container->compute_cell(cell, block, k))
          measures[static_cast<std::size_t>(container->id[block][k])] = cell.volume();
}

}  // namespace

std::vector<double> voro_measures(const SeedsView& seeds, const Box& box) {
  std::vector<double> measures(seeds.size(), 0.0);
  std::atomic<int> next_row = 0;
  measure_rows(seeds, box, next_row, measures);
  return measures;
}

std::vector<double> voro_parallel_measures(const SeedsView& seeds, const Box& box) {
  std::vector<double> measures(seeds.size(), 0.0);
  std::atomic<int> next_row = 0;
  std::vector<std::jthread> threads;
  for (unsigned t = 0; t < std::thread::hardware_concurrency(); ++t)
    threads.emplace_back([&] { measure_rows(seeds, box, next_row, measures); });
  threads.clear();  // joins
  return measures;
}

}  // namespace powercell::bench
