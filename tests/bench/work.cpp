// The work counted for a cell in known cases: grids, and the white cells of docs/performance.md.
#include "apps/bench/work.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "apps/io/tables/read_seeds.hpp"

using namespace powercell;
using namespace powercell::app;

namespace {

const Device& device() {
  static const auto* chosen = new Device(Device::choose());
  return *chosen;
}

// Exact if per_axis is a power of two, so that rounding creates no slivers, and if ties are not broken.
std::vector<double> grid(int per_axis, int dimension) {
  std::vector<double> positions;
  const int count = dimension == 3 ? per_axis * per_axis * per_axis : per_axis * per_axis;
  for (int i = 0; i < count; ++i)
    for (int k = 0, rest = i; k < dimension; ++k, rest /= per_axis)
      positions.push_back((rest % per_axis + 0.5) / per_axis);
  return positions;
}

Work work_of(const Domain& domain, const std::vector<double>& positions) {
  Options options;
  options.decisions = Decisions::fast;
  Diagram diagram(device(), domain, options);
  diagram.set_seeds({domain.dimension(), positions, {}});
  return count_work(domain, diagram.cells(), positions);
}

double measure_of_parts(const io::LoadedDomain& domain, double share) {
  return part_of(domain, share).measure() / domain.domain.measure();
}

}  // namespace

TEST_CASE("a grid of boxes") {
  const Work work = work_of(io::read_domain("cube").domain, grid(8, 3));
  CHECK(work.pieces == 1);
  CHECK(work.corners == 8);
  CHECK(work.triangles == 12);
  // The diagonal of a box is sqrt(3) of its edges; at the boundary less of the ball of that radius is inside.
  const double ball = 4 * std::numbers::pi / 3 * std::pow(3.0, 1.5);
  CHECK(work.near < ball);
  CHECK(work.near > 0.6 * ball);
  CHECK(work.corner_tests == doctest::Approx(8 * work.near));
  CHECK(work.operations() == doctest::Approx(work.near * (10 + 8 * 6) + 8 * 16 + 12 * 40));
  CHECK(work.bytes(8) == doctest::Approx(4 * 8 + 4 + 8 + 2 * 5 * 8));
}

TEST_CASE("a grid of squares") {
  const Work work = work_of(io::read_domain("square").domain, grid(32, 2));
  CHECK(work.pieces == 1);
  CHECK(work.corners == 4);
  CHECK(work.triangles == 2);
  CHECK(work.near < 2 * std::numbers::pi);
  CHECK(work.near > 1.7 * std::numbers::pi);
  CHECK(work.operations() == doctest::Approx(work.near * (7 + 4 * 4) + 4 * 11 + 2 * 20));
}

TEST_CASE("white cells as in docs/performance.md") {
  const Domain cube = io::read_domain("cube").domain;
  const Work work = work_of(cube, io::random_seeds({10000, 0, 0, 1}, cube).positions);
  CHECK(work.operations() > 8e3);
  CHECK(work.operations() < 12e3);
  CHECK(work.bytes(8) == doctest::Approx(124));
}

TEST_CASE("a part of a domain has its share of the measure and of the regions") {
  for (const char* spec : {"sphere:16", "ball:6"}) {
    CAPTURE(spec);
    const io::LoadedDomain whole = io::read_domain(spec);
    for (const double share : {0.5, 0.1}) {
      // Exceeded by no more than the last element.
      CHECK(measure_of_parts(whole, share) >= share);
      CHECK(measure_of_parts(whole, share) < share + 0.01);
      CHECK(static_cast<double>(part_of(whole, share).region_count()) ==
            doctest::Approx(share * static_cast<double>(whole.domain.region_count())).epsilon(0.35));
    }
    CHECK(part_of(whole, 1e-9).region_count() == 1);
    CHECK(part_of(whole, 1).region_count() == whole.domain.region_count());
  }
  CHECK(part_of(io::read_domain("cube"), 0.1).measure() == 1);
  CHECK(part_of(io::read_domain("disk"), 0.1).measure() == io::read_domain("disk").domain.measure());
}

TEST_CASE("pieces of a part are like those of the whole") {
  // With the same density and the same tetrahedra the counted work must not depend on the share.
  const io::LoadedDomain whole = io::read_domain("ball:8");
  const Domain part = part_of(whole, 0.25);
  const Work of_whole = work_of(whole.domain, io::random_seeds({4000, 0, 0, 1}, whole.domain).positions);
  const Work of_part = work_of(part, io::random_seeds({1000, 0, 0, 1}, part).positions);
  CHECK(of_part.pieces == doctest::Approx(of_whole.pieces).epsilon(0.15));
  CHECK(of_part.corners == doctest::Approx(of_whole.corners).epsilon(0.15));
  CHECK(of_part.operations() == doctest::Approx(of_whole.operations()).epsilon(0.3));
}
