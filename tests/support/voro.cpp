#include "tests/support/voro.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <voro++/voro++.hh>

namespace powercell::test {

namespace {

constexpr double seeds_per_block = 5;  // voro++'s own advice

void put_all(voro::container_poly& container, voro::particle_order& order, const SeedsView& seeds) {
  double least = 0;
  if (!seeds.weights.empty()) least = *std::min_element(seeds.weights.begin(), seeds.weights.end());
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const double* p = &seeds.positions[3 * i];
    const double radius = seeds.weights.empty() ? 0 : std::sqrt(seeds.weights[i] - least);
    container.put(order, static_cast<int>(i), p[0], p[1], p[2], radius);
  }
  if (container.total_particles() != static_cast<int>(seeds.size()))
    throw std::invalid_argument("voro++ left out seeds outside the box");
}

struct Row {
  double volume = 0;
  std::vector<std::pair<std::uint32_t, double>> walls;
};

Row read_cell(voro::voronoicell_neighbor& cell) {
  Row row;
  row.volume = cell.volume();
  std::vector<int> neighbors;
  std::vector<double> areas;
  cell.neighbors(neighbors);
  cell.face_areas(areas);
  for (std::size_t f = 0; f < neighbors.size(); ++f)
    if (neighbors[f] >= 0) row.walls.emplace_back(static_cast<std::uint32_t>(neighbors[f]), areas[f]);
  std::sort(row.walls.begin(), row.walls.end());
  return row;
}

}  // namespace

RadicalCells radical_cells(const SeedsView& seeds, const Box& box) {
  const std::size_t n = seeds.size();
  const int blocks = std::max(1, static_cast<int>(std::cbrt(static_cast<double>(n) / seeds_per_block)));
  voro::container_poly container(box.low[0], box.high[0], box.low[1], box.high[1], box.low[2], box.high[2],
                                 blocks, blocks, blocks, false, false, false, 8);
  voro::particle_order order;
  put_all(container, order, seeds);

  std::vector<Row> rows(n);
  voro::voronoicell_neighbor cell;
  voro::c_loop_order loop(container, order);
  if (loop.start()) do
      if (container.compute_cell(cell, loop)) rows[static_cast<std::size_t>(loop.pid())] = read_cell(cell);
    while (loop.inc());

  RadicalCells cells;
  cells.offset.push_back(0);
  for (const Row& row : rows) {
    cells.volume.push_back(row.volume);
    for (const auto& [neighbor, area] : row.walls) {
      cells.neighbor.push_back(neighbor);
      cells.wall.push_back(area);
    }
    cells.offset.push_back(cells.neighbor.size());
  }
  return cells;
}

namespace {

template <class Container>
void put_with_radii(Container& container, const SeedsView& seeds) {
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const double* p = &seeds.positions[3 * i];
    container.put(static_cast<int>(i), p[0], p[1], p[2], std::sqrt(seeds.weights[i]));
  }
}

template <class Loop, class Container>
std::vector<double> volumes(Container& container, std::size_t n) {
  std::vector<double> volume(n);
  voro::voronoicell_neighbor cell;
  Loop loop(container);
  if (loop.start()) do
      if (container.compute_cell(cell, loop)) volume[static_cast<std::size_t>(loop.pid())] = cell.volume();
    while (loop.inc());
  return volume;
}

int blocks_for(const SeedsView& seeds) {
  return std::max(1, static_cast<int>(std::cbrt(static_cast<double>(seeds.size()) / seeds_per_block)));
}

}  // namespace

std::vector<double> periodic_volumes(const SeedsView& seeds, const Box& box, std::array<bool, 3> periodic) {
  const int blocks = blocks_for(seeds);
  voro::container_poly container(box.low[0], box.high[0], box.low[1], box.high[1], box.low[2], box.high[2],
                                 blocks, blocks, blocks, periodic[0], periodic[1], periodic[2], 8);
  put_with_radii(container, seeds);
  return volumes<voro::c_loop_all>(container, seeds.size());
}

std::vector<double> triclinic_volumes(const SeedsView& seeds, const std::array<double, 6>& unit) {
  const int blocks = blocks_for(seeds);
  voro::container_periodic_poly container(unit[0], unit[1], unit[2], unit[3], unit[4], unit[5], blocks,
                                          blocks, blocks, 8);
  put_with_radii(container, seeds);
  return volumes<voro::c_loop_all_periodic>(container, seeds.size());
}

}  // namespace powercell::test
