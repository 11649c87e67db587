/// \file
/// Cells of seeds in shards against those of one diagram.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <powercell/diagram.hpp>
#include <string>
#include <vector>

#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"
#include "tests/support/shares.hpp"

namespace powercell::test {

inline Shares at_random(const SeedArray& seeds, std::size_t count, Random& random) {
  std::vector<std::size_t> shard(seeds.size());
  for (std::size_t& s : shard) s = random.index(count);
  return {seeds, shard, count};
}

/// What the measure of a cell may be off by: its surface, about, moved by the rounding of its vertices. These
/// are cut from a region as large as the domain, and more of them in another order; in a periodic domain from
/// a box of three times its edges, and needles around it have twice the surface.
inline double measure_error(const Domain& domain, double measure) {
  const auto d = static_cast<double>(domain.dimension());
  double extent = 0;
  for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, domain.high()[k] - domain.low()[k]);
  if (domain.is_periodic()) extent *= 6;
  return 2e-16 * extent * 2 * d * std::pow(measure, (d - 1) / d);
}

/// The neighbours, statuses and measures of cells are those of a diagram of all seeds. Measures differ by
/// rounding, because the order of cuts depends on the tree of the seeds at hand.
/// \param ids  of the cells' seeds: their indices in the diagram \param cells  of shards, or distributed
template <class CellsOfSome>
void check_cells(Diagram& diagram, const std::vector<std::uint64_t>& ids, const CellsOfSome& cells) {
  const Measures& measures = diagram.measures();
  const Adjacency& adjacency = diagram.adjacency();
  const double mean = measures.domain_measure / static_cast<double>(std::max<std::size_t>(diagram.size(), 1));
  const double most_wall =
      adjacency.wall.empty() ? 0 : *std::max_element(adjacency.wall.begin(), adjacency.wall.end());
  const auto d = static_cast<std::size_t>(measures.dimension);
  double most_error = 0;
  for (const double x : measures.centroid)
    if (std::isfinite(x)) most_error = std::max(most_error, 1e-9 * std::abs(x));
  // Cells of a periodic domain may reach around it, as needles.
  const double wall_error = (diagram.domain().is_periodic() ? 4e-11 : 1e-12) * most_wall;
  REQUIRE(cells.measures.mass.size() == ids.size());
  REQUIRE(cells.offset.size() == ids.size() + 1);
  REQUIRE(cells.shift.size() == (adjacency.shift.empty() ? 0 : cells.neighbor.size()));
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const std::size_t i = ids[k];
    CAPTURE(i);
    CHECK(cells.measures.status[k] == measures.status[i]);
    CHECK(std::abs(cells.measures.mass[k] - measures.mass[i]) <=
          measure_error(diagram.domain(), std::max(mean, measures.mass[i])));
    if (measures.mass[i] > 1e-6 * mean)  // of smaller ones they are not known better
      for (std::size_t c = 0; c < d; ++c)
        CHECK(std::abs(cells.measures.centroid[k * d + c] - measures.centroid[i * d + c]) <= most_error);
    const std::size_t count = adjacency.offset[i + 1] - adjacency.offset[i];
    REQUIRE(cells.offset[k + 1] - cells.offset[k] == count);
    for (std::size_t w = 0; w < count; ++w) {
      CHECK(cells.neighbor[cells.offset[k] + w] == adjacency.neighbor[adjacency.offset[i] + w]);
      CHECK(std::abs(cells.wall[cells.offset[k] + w] - adjacency.wall[adjacency.offset[i] + w]) <=
            wall_error);
      if (!adjacency.shift.empty())
        CHECK(cells.shift[cells.offset[k] + w] == adjacency.shift[adjacency.offset[i] + w]);
    }
  }
}

/// The cells of all shards are those of one diagram.
inline exchange::ExchangeReport check_shares(
    Diagram& diagram, const Shares& shares,
    const exchange::Estimate& estimate = &exchange::Shard::boundaries) {
  const exchange::ShardedDiagram sharded =
      exchange::compute_shards(diagram.device(), diagram.domain(), shares.view(), {}, estimate);
  REQUIRE(sharded.shards.size() == shares.ids.size());
  for (std::size_t s = 0; s < shares.ids.size(); ++s) check_cells(diagram, shares.ids[s], sharded.shards[s]);
  CHECK(sharded.report.fetched >= sharded.report.neighbors);
  return sharded.report;
}

/// A diagram of all seeds.
inline Diagram diagram_of(const Domain& domain, const SeedArray& seeds) {
  Diagram diagram(test_device(), domain);
  diagram.set_seeds(seeds.view());
  diagram.compute(true, false);
  return diagram;
}

}  // namespace powercell::test
