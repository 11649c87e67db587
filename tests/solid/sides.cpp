// Which vertices of cells lie inside: found, and refused where crossings contradict each other.
#include "lib/solid/sides.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "kernels/layout.h"
#include "lib/scene/domain_buffers.hpp"
#include "lib/solid/cell_in_solid.hpp"

using namespace powercell;
using solid::Side;

namespace {

/// The cube |x|, |y|, |z| <= 1 about a seed, its faces walls with the seeds 1 to 6, and the part of it with
/// z <= h: a boundary of two pieces.
struct CutCube {
  std::vector<std::int32_t> border{1, 2, 3, 4, 5, 6};
  std::vector<double> area{4, 4, 4, 4, 4, 4}, vertex;
  std::vector<std::uint32_t> link;
  std::vector<double> positions{0, 0, 0, -2, 0, 0, 2, 0, 0, 0, -2, 0, 0, 2, 0, 0, 0, -2, 0, 0, 2};
  std::vector<std::int32_t> lower_border{3, 2, -1, 1}, upper_border{-1, 2, 4, 1};
  std::vector<double> lower, upper;
  std::vector<std::uint32_t> edges{0, 1, 2};

  explicit CutCube(double h)
      : lower{-1, -1, h, 1, -1, h, 1, .5, h, -1, -.5, h}, upper{-1, -.5, h, 1, .5, h, 1, 1, h, -1, 1, h} {
    const region_shape_t shape = region_shape(RegionShape::box);
    for (int v = 0; v < 8; ++v) {
      for (int k = 0; k < 3; ++k) vertex.push_back(v >> k & 1 ? 1 : -1);
      for (int k = 0; k < 3; ++k) link.push_back(static_cast<std::uint32_t>(shape.next[k][v]));
      for (int k = 0; k < 3; ++k) link.push_back(static_cast<std::uint32_t>(shape.face[k][v]));
    }
  }
  solid::BoundaryPiece lower_piece() const { return {lower_border, lower, edges}; }
  solid::BoundaryPiece upper_piece() const { return {upper_border, upper, edges}; }
  solid::WholeCell cell() const { return {border, area, vertex, link}; }
};

}  // namespace

TEST_CASE("solid: a cube cut by a plane") {
  const CutCube cube(0.5);
  solid::CellInSolid in_solid;
  in_solid.start(0, cube.cell(), cube.positions);
  in_solid.add(cube.lower_piece());
  in_solid.add(cube.upper_piece());
  REQUIRE(in_solid.label());
  CHECK(!in_solid.uniform());
  for (std::uint32_t v = 0; v < 8; ++v) CHECK(in_solid.side(v) == (v < 4 ? Side::inside : Side::outside));
  const solid::SolidPart part = in_solid.part();
  CHECK(!part.thin);
  CHECK(part.moments[0] == doctest::Approx(6));
  CHECK(part.moments[3] == doctest::Approx(6 * -0.25));
  CHECK(part.moments[4] == doctest::Approx(2 * 4 * 1.5 / 3 + 4 * (0.125 + 1) / 3));
  CHECK(part.neighbors == std::vector<std::uint32_t>{1, 2, 3, 4, 5});
  for (std::size_t k = 0; k < 4; ++k) CHECK(part.areas[k] == doctest::Approx(3));
  CHECK(part.areas[4] == 4);
}

TEST_CASE("solid: broken boundaries are noticed") {
  const CutCube cube(0.5);
  solid::CellInSolid in_solid;
  const auto labelled = [&](std::initializer_list<solid::BoundaryPiece> pieces) {
    in_solid.start(0, cube.cell(), cube.positions);
    for (const solid::BoundaryPiece& piece : pieces) in_solid.add(piece);
    return in_solid.label();
  };
  const solid::BoundaryPiece lower = cube.lower_piece(), upper = cube.upper_piece();
  CHECK(labelled({lower, upper}));
  // A piece is missing, or there twice.
  CHECK(!labelled({lower}));
  CHECK(!labelled({lower, upper, lower}));
  // A piece is inside out.
  std::vector<double> turned;
  for (std::size_t k = 4; k-- > 0;) turned.insert(turned.end(), &cube.lower[3 * k], &cube.lower[3 * k] + 3);
  const std::vector<std::int32_t> turned_border{-1, 2, 3, 1};
  CHECK(!labelled({{turned_border, turned, cube.edges}, upper}));
  // A border is not a wall of the cell.
  const std::vector<std::int32_t> unknown_border{3, 7, -1, 1};
  CHECK(!labelled({{unknown_border, cube.lower, cube.edges}, upper}));
}

TEST_CASE("solid: sides spread between cells that the boundary does not cross") {
  // A row of cells 0 - 1 - 2 - 3 - 4 - 5, of which 3 is crossed.
  std::vector<std::vector<std::uint32_t>> row{{1}, {0, 2}, {1, 3}, {2, 4}, {3, 5}, {4}};
  const auto neighbors = [&](std::uint32_t rank) { return std::span<const std::uint32_t>(row[rank]); };
  const std::vector<bool> one_sided{true, true, true, false, true, true};
  SideHints hints;
  hints.seen = {0, 0, SideHints::inside, SideHints::looked, SideHints::outside, 0};
  const std::vector<Side> side = find_sides({one_sided, hints, neighbors, {}});
  const std::vector<Side> expected{Side::inside,  Side::inside,  Side::inside,
                                   Side::unknown, Side::outside, Side::outside};
  CHECK(side == expected);

  // What a crossed cell has not seen is outside.
  hints.seen[2] = 0;
  CHECK(find_sides({one_sided, hints, neighbors, {}})[0] == Side::outside);
  hints.seen[2] = SideHints::inside;

  // Neighbours that contradict each other decide nothing.
  hints.seen[1] = SideHints::outside;
  const std::vector<Side> broken = find_sides({one_sided, hints, neighbors, {}});
  CHECK(std::count(broken.begin(), broken.end(), Side::unknown) == 6);
}
