#include "tests/collect/join_laws.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include "tests/support/polytope.hpp"

namespace powercell::test {
namespace {

Vec at(const std::vector<double>& vertices, std::uint64_t v, int dimension) {
  const double* x = &vertices[v * static_cast<std::size_t>(dimension)];
  return {x[0], x[1], dimension == 3 ? x[2] : 0.0};
}

/// Twice the vector area of a loop.
template <class Corner>
Vec twice_area(std::size_t n, const Corner& corner) {
  Vec sum;
  for (std::size_t k = 2; k < n; ++k) sum = sum + cross(corner(k - 1) - corner(0), corner(k) - corner(0));
  return sum;
}

/// Six times the volume of the cones from `apex` over a loop.
template <class Corner>
Real six_cones(std::size_t n, const Vec& apex, const Corner& corner) {
  Real sum = 0;
  for (std::size_t k = 2; k < n; ++k)
    sum += dot(corner(0) - apex, cross(corner(k - 1) - apex, corner(k) - apex));
  return sum;
}

void check_closed(const JoinedCell& cell) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (std::size_t f = 0; f < cell.face_count(); ++f) {
    for (std::uint64_t k = cell.begin(f); k < cell.end(f); ++k) {
      const std::uint32_t a = cell.cells.loop[k];
      const std::uint32_t b = cell.cells.loop[k + 1 < cell.end(f) ? k + 1 : cell.begin(f)];
      ++uses[{a, b}];
      --uses[{b, a}];
    }
  }
  for (const auto& [edge, balance] : uses) CHECK(balance == 0);
}

}  // namespace

double JoinedCell::ring_area(std::size_t f) const {
  const auto corner = [&](std::size_t k) {
    return at(cells.vertices, cells.vertex_offset[i] + cells.loop[begin(f) + k], cells.dimension);
  };
  return static_cast<double>(twice_area(corner_count(f), corner).z / 2);
}

double JoinedCell::measure() const {
  Real sum = 0;
  for (std::size_t f = 0; f < face_count(); ++f) {
    const auto corner = [&](std::size_t k) {
      return at(cells.vertices, cells.vertex_offset[i] + cells.loop[begin(f) + k], cells.dimension);
    };
    if (cells.cell_dimension == 3) {
      sum += six_cones(corner_count(f), at(cells.vertices, cells.vertex_offset[i], 3), corner) / 6;
    } else if (cells.dimension == 3) {
      sum += length(twice_area(corner_count(f), corner)) / 2;
    } else {
      sum += ring_area(f);
    }
  }
  return static_cast<double>(sum);
}

double pieces_measure(const Cells& cells, std::size_t i) {
  Real sum = 0;
  for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p) {
    const std::uint64_t first = cells.vertex_offset[p];
    if (cells.cell_dimension == 2) {
      const auto corner = [&](std::size_t k) { return at(cells.vertices, first + k, cells.dimension); };
      sum += length(twice_area(cells.vertex_offset[p + 1] - first, corner)) / 2;
      continue;
    }
    for (std::uint64_t f = cells.face_offset[p]; f < cells.face_offset[p + 1]; ++f) {
      const auto corner = [&](std::size_t k) {
        return at(cells.vertices, first + cells.loop[cells.loop_offset[f] + k], 3);
      };
      sum +=
          six_cones(cells.loop_offset[f + 1] - cells.loop_offset[f], at(cells.vertices, first, 3), corner) /
          6;
    }
  }
  return static_cast<double>(sum);
}

void check_join_laws(const Domain& domain, const Cells& cells, const JoinedCells& joined, double tolerance) {
  REQUIRE(joined.vertex_offset.size() == cells.cell_count() + 1);
  REQUIRE(joined.face_offset.size() == cells.cell_count() + 1);
  REQUIRE(joined.loop_offset.size() == joined.face_offset.back() + 1);
  REQUIRE(joined.loop_offset.back() == joined.loop.size());
  REQUIRE(joined.vertices.size() == joined.vertex_offset.back() * static_cast<std::size_t>(joined.dimension));
  const bool volume = domain.kind() == DomainKind::volume;
  CHECK(joined.edge_border.size() == (volume ? 0 : joined.loop.size()));
  CHECK(joined.face_border.size() == (volume ? joined.face_offset.back() : 0));
  for (std::size_t i = 0; i < cells.cell_count(); ++i) {
    INFO("cell " << i);
    const JoinedCell cell(joined, i);
    CHECK(std::abs(cell.measure() - pieces_measure(cells, i)) <= tolerance);
    std::set<std::uint32_t> used;
    for (std::size_t f = 0; f < cell.face_count(); ++f) {
      const std::set<std::uint32_t> corners(joined.loop.begin() + static_cast<std::ptrdiff_t>(cell.begin(f)),
                                            joined.loop.begin() + static_cast<std::ptrdiff_t>(cell.end(f)));
      CHECK(corners.size() == cell.corner_count(f));
      CHECK(corners.size() > 2);
      used.insert(corners.begin(), corners.end());
    }
    CHECK(used.size() == cell.vertex_count());
    CHECK((used.empty() || *used.rbegin() + 1 == used.size()));
    if (volume) check_closed(cell);
  }
}

std::size_t interior_count(const JoinedCells& joined) {
  const auto& borders = joined.cell_dimension == 3 ? joined.face_border : joined.edge_border;
  return static_cast<std::size_t>(std::count_if(
      borders.begin(), borders.end(), [](const Border& b) { return b.kind == Border::Kind::interior; }));
}

}  // namespace powercell::test
