#include "tests/fuzz/laws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace powercell::fuzz {
namespace {

using Real = long double;

constexpr double kRoundings = 128;  // verify() allows 64 in each of the two cells beside a plane

double unit_of(Precision precision) {
  return precision == Precision::float32 ? 0x1p-24 : 0x1p-53;
}

double size_of(const Domain& domain) {
  const auto low = domain.low(), high = domain.high();
  return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

Real weight(const SeedsView& seeds, std::size_t i) {
  return seeds.weights.empty() ? 0 : seeds.weights[i];
}

Real distance(const SeedsView& seeds, std::size_t i, std::size_t j) {
  const auto d = static_cast<std::size_t>(seeds.dimension);
  Real sum = 0;
  for (std::size_t k = 0; k < d; ++k) {
    const Real difference = static_cast<Real>(seeds.positions[i * d + k]) - seeds.positions[j * d + k];
    sum += difference * difference;
  }
  return std::sqrt(sum);
}

/// (|x - p_i|^2 - w_i) - (|x - p_j|^2 - w_j): by differences, since weights may be beyond the digits of
/// distances.
Real power_beyond(const SeedsView& seeds, std::size_t i, std::size_t j, const std::vector<Real>& x) {
  const auto d = static_cast<std::size_t>(seeds.dimension);
  Real sum = weight(seeds, j) - weight(seeds, i);
  for (std::size_t k = 0; k < d; ++k) {
    const Real p = seeds.positions[i * d + k], q = seeds.positions[j * d + k];
    sum += (q - p) * ((x[k] - p) + (x[k] - q));
  }
  return sum;
}

/// From the seed to the farthest corner of the domain's box.
Real reach(const Domain& domain, const SeedsView& seeds, std::size_t i) {
  const auto low = domain.low(), high = domain.high();
  const auto d = static_cast<std::size_t>(seeds.dimension);
  Real sum = 0;
  for (std::size_t k = 0; k < d; ++k) {
    const Real p = seeds.positions[i * d + k];
    const Real far = std::max(std::fabs(p - low[k]), std::fabs(p - high[k]));
    sum += far * far;
  }
  return std::sqrt(sum);
}

template <class Offset>
void check_offsets(const std::vector<Offset>& offset, std::size_t rows, std::size_t end, const char* what) {
  require(offset.size() == rows + 1 && offset.front() == 0 && offset.back() == end &&
              std::ranges::is_sorted(offset),
          std::string("offsets of ") + what + " do not fit");
}

/// A number that is not negative, and finite unless the bound of it is beyond the range of doubles.
void require_in_range(double x, Real bound, const std::string& what) {
  require(x >= 0 && (std::isfinite(x) || bound > 1e290L), what + " is " + std::to_string(x));
}

}  // namespace

const Device& shared_device() {
  static const auto* device = new Device(Device::choose());
  return *device;
}

double plane_error(const Domain& domain, const SeedsView& seeds, Precision precision) {
  const Real unit = kRoundings * unit_of(precision);
  const auto low = domain.low(), high = domain.high();
  Real worst = 0;
  for (std::size_t k = 0; k < 3; ++k)
    worst = std::max<Real>(worst, 8 * 0x1p-53 * std::max(std::fabs(low[k]), std::fabs(high[k])));
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const Real far = reach(domain, seeds, i);
    worst = std::max(worst, unit * far);
    for (std::size_t j = 0; j < seeds.size(); ++j) {
      const Real q = distance(seeds, i, j);
      if (q == 0) continue;
      const Real lift = (weight(seeds, i) - weight(seeds, j)) / q;
      const Real error = unit * (far + q + std::fabs(lift));
      if (std::fabs(q + lift) / 2 - error <= far) worst = std::max(worst, error);
    }
  }
  return static_cast<double>(worst);
}

double sum_doubt(const Domain& domain, std::size_t walls, double error) {
  return static_cast<double>(walls) * error * std::pow(size_of(domain), domain.cell_dimension() - 1) /
         domain.measure();
}

void check_measures(const Measures& measures, const Domain& domain, const SeedsView& seeds, double error) {
  const std::size_t n = seeds.size(), d = static_cast<std::size_t>(seeds.dimension);
  require(measures.mass.size() == n && measures.status.size() == n && measures.second_moment.size() == n &&
              measures.centroid.size() == n * d,
          "measures of another size than the seeds");
  for (std::size_t i = 0; i < n; ++i) {
    const std::string seed = "seed " + std::to_string(i) + ": ";
    const bool ok = measures.status[i] == SeedStatus::ok;
    const Real mass_at_most = std::pow(size_of(domain), static_cast<Real>(domain.cell_dimension()));
    const Real far = reach(domain, seeds, i);
    require_in_range(measures.mass[i], mass_at_most, seed + "the mass");
    require_in_range(measures.second_moment[i], mass_at_most * far * far, seed + "the second moment");
    require(ok ? measures.mass[i] > 0 : measures.mass[i] == 0,
            seed + "mass and status contradict each other");
    for (std::size_t k = 0; k < d; ++k)
      require(std::isnan(measures.centroid[i * d + k]) == !ok, seed + "centroid and status contradict");
  }
  if (n == 0) return;
  const double allowed = sum_doubt(domain, n, error);
  if (allowed < 0.01)
    require(measures.relative_error() <= 1e-12 + 8 * allowed, "the masses sum to the domain's but for " +
                                                                  std::to_string(measures.relative_error()) +
                                                                  ", allowed are " + std::to_string(allowed));
}

void check_adjacency(const Adjacency& adjacency, const Measures& measures) {
  const std::size_t n = measures.mass.size();
  check_offsets(adjacency.offset, n, adjacency.neighbor.size(), "adjacency");
  require(adjacency.wall.size() == adjacency.neighbor.size(), "walls and neighbours differ in number");
  for (std::size_t i = 0; i < n; ++i) {
    for (std::uint64_t k = adjacency.offset[i]; k < adjacency.offset[i + 1]; ++k) {
      const std::uint32_t j = adjacency.neighbor[k];
      require(j < n && j != i, "a neighbour that is no other seed");
      require(k == adjacency.offset[i] || adjacency.neighbor[k - 1] < j, "a row is not ascending");
      require(std::isfinite(adjacency.wall[k]) && adjacency.wall[k] >= 0, "a wall of no measure");
      require(measures.status[i] != SeedStatus::duplicate, "a duplicate has a neighbour");
      const auto begin = adjacency.neighbor.begin() + static_cast<std::ptrdiff_t>(adjacency.offset[j]);
      const auto end = adjacency.neighbor.begin() + static_cast<std::ptrdiff_t>(adjacency.offset[j + 1]);
      const auto back = std::lower_bound(begin, end, i);
      require(back != end && *back == i, "a wall that one side does not have");
      require(
          adjacency.wall[static_cast<std::size_t>(back - adjacency.neighbor.begin())] == adjacency.wall[k],
          "a wall that differs from its other side");
    }
  }
}

void check_cells(const Cells& cells, const Domain& domain, const SeedsView& seeds, double error) {
  const std::size_t n = seeds.size(), d = static_cast<std::size_t>(seeds.dimension);
  const std::size_t pieces = cells.piece_count(), faces = cells.border.size();
  check_offsets(cells.cell_offset, n, pieces, "cells");
  check_offsets(cells.vertex_offset, pieces, cells.vertices.size() / d, "vertices");
  check_offsets(cells.face_offset, pieces, faces, "faces");
  if (cells.cell_dimension == 3) check_offsets(cells.loop_offset, faces, cells.loop.size(), "loops");
  for (const double x : cells.vertices) require(std::isfinite(x), "a vertex that is not finite");
  for (const Border& border : cells.border) {
    if (border.kind == Border::Kind::wall) require(border.index < n, "a wall to no seed");
    if (border.kind == Border::Kind::interior) require(border.index < domain.region_count(), "no region");
  }
  // What is left of coordinates: seeds that are one there are a tie.
  const Real least = 0x1p-1073L * size_of(domain);
  for (std::size_t i = 0; i < n; ++i) {
    const Real tie = 4 * least * reach(domain, seeds, i);
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p) {
      require(cells.region[p] < domain.region_count(), "a piece in no region");
      const std::uint64_t begin = cells.vertex_offset[p], end = cells.vertex_offset[p + 1];
      require(begin < end, "a piece without vertices");
      std::vector<Real> middle(d, 0);
      for (std::uint64_t v = begin; v < end; ++v)
        for (std::size_t k = 0; k < d; ++k)
          middle[k] += static_cast<Real>(cells.vertices[v * d + k]) / static_cast<Real>(end - begin);
      for (std::size_t j = 0; j < n; ++j) {
        const Real allowed = 2 * distance(seeds, i, j) * 4 * static_cast<Real>(error) + tie;
        require(power_beyond(seeds, i, j, middle) <= allowed,
                "a piece of seed " + std::to_string(i) + " lies in the cell of seed " + std::to_string(j));
      }
    }
  }
}

void check_dual(const Dual& dual, const Measures& measures) {
  if (dual.simplices.empty()) return;
  require(dual.corners == 3 || dual.corners == 4, "simplices of neither 3 nor 4 corners");
  const auto corners = static_cast<std::size_t>(dual.corners);
  require(dual.simplices.size() % corners == 0, "no whole number of simplices");
  for (std::size_t s = 0; s < dual.size(); ++s) {
    std::vector<std::uint32_t> row(dual.simplices.begin() + static_cast<std::ptrdiff_t>(s * corners),
                                   dual.simplices.begin() + static_cast<std::ptrdiff_t>((s + 1) * corners));
    for (const std::uint32_t v : row) {
      require(v < measures.mass.size(), "a corner that is no seed");
      require(measures.status[v] == SeedStatus::ok, "a corner that is a seed without a cell");
    }
    std::ranges::sort(row);
    require(std::ranges::adjacent_find(row) == row.end(), "a simplex with a corner twice");
  }
}

void check_joined(const JoinedCells& joined, std::size_t seeds) {
  const auto d = static_cast<std::size_t>(joined.dimension);
  const std::size_t faces = joined.loop_offset.empty() ? 0 : joined.loop_offset.size() - 1;
  check_offsets(joined.vertex_offset, seeds, joined.vertices.size() / d, "joined vertices");
  check_offsets(joined.face_offset, seeds, faces, "joined faces");
  check_offsets(joined.loop_offset, faces, joined.loop.size(), "joined loops");
  for (std::size_t i = 0; i < seeds; ++i) {
    const std::uint64_t room = joined.vertex_offset[i + 1] - joined.vertex_offset[i];
    for (std::uint64_t f = joined.face_offset[i]; f < joined.face_offset[i + 1]; ++f)
      for (std::uint64_t k = joined.loop_offset[f]; k < joined.loop_offset[f + 1]; ++k)
        require(joined.loop[k] < room, "a loop with a vertex of another cell");
  }
}

}  // namespace powercell::fuzz
