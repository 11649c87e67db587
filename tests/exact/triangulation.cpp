// The regular triangulation against CGAL's, simplex by simplex. With ties, which CGAL breaks differently, it
// must be a triangulation of the hull.
#include <doctest/doctest.h>

#include <algorithm>
#include <powercell/triangulation.hpp>

#include "tests/exact/check_triangulation.hpp"
#include "tests/support/cgal.hpp"
#include "tests/support/generators.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// The measure of the bounding box, which is the hull of a grid.
long double box_measure(const SeedArray& seeds) {
  long double measure = 1;
  for (int k = 0; k < seeds.dimension; ++k) {
    double low = seeds.coordinate(0, k), high = low;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      low = std::min(low, seeds.coordinate(i, k));
      high = std::max(high, seeds.coordinate(i, k));
    }
    measure *= static_cast<long double>(high) - low;
  }
  return measure;
}

std::vector<std::vector<std::uint32_t>> sorted_rows(const std::vector<std::uint32_t>& corners,
                                                    std::size_t width) {
  std::vector<std::vector<std::uint32_t>> rows;
  for (std::size_t at = 0; at < corners.size(); at += width) {
    rows.emplace_back(corners.begin() + static_cast<std::ptrdiff_t>(at),
                      corners.begin() + static_cast<std::ptrdiff_t>(at + width));
    std::sort(rows.back().begin(), rows.back().end());
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

}  // namespace

TEST_CASE("random seeds: CGAL's triangulation, simplex by simplex") {
  Random random(test_seed());
  for (const int dimension : {2, 3})
    for (const WeightRange weights : {WeightRange::W0, WeightRange::W1, WeightRange::W2})
      for (const Distribution distribution : {Distribution::white, Distribution::cluster})
        for (const std::size_t n :
             {std::size_t{5}, std::size_t{60}, std::size_t{number_of_inputs(300u, 1000u)}}) {
          CAPTURE(dimension);
          CAPTURE(name(weights));
          CAPTURE(n);
          const SeedArray seeds = random_seeds(distribution, weights, n, dimension, random);
          const Dual dual = regular_triangulation(Device::choose(), seeds.view());
          const auto width = static_cast<std::size_t>(dimension) + 1;
          CHECK(sorted_rows(dual.simplices, width) ==
                sorted_rows(regular_triangulation(seeds.view()).simplices, width));
          CHECK(check_triangulation(dual, seeds).faults == 0);
        }
}

TEST_CASE("a grid: the hull is covered once") {
  for (const int dimension : {2, 3}) {
    const SeedArray seeds = grid(dimension == 2 ? 12 : 5, dimension);
    const Dual dual = regular_triangulation(Device::choose(), seeds.view());
    const Triangulated triangulated = check_triangulation(dual, seeds);
    CHECK(triangulated.faults == 0);
    const long double covered = triangulated.measure, hull = box_measure(seeds);
    CHECK(static_cast<double>(covered / hull) == doctest::Approx(1).epsilon(1e-13));
  }
}

TEST_CASE("seeds whose cells are exactly flat are no vertices") {
  for (const int dimension : {2, 3}) {
    // The weight of the middle one of three in a row is such that its two bisectors coincide.
    SeedArray seeds = grid(dimension == 2 ? 8 : 5, dimension);
    const auto n = seeds.size();
    const double h = seeds.coordinate(1, 0) - seeds.coordinate(0, 0);
    seeds.weights[n / 2] -= h * h;
    const Dual dual = regular_triangulation(Device::choose(), seeds.view());
    const Triangulated triangulated = check_triangulation(dual, seeds);
    CHECK(triangulated.faults == 0);
    CHECK(static_cast<double>(triangulated.measure / box_measure(seeds)) ==
          doctest::Approx(1).epsilon(1e-13));
  }
}

TEST_CASE("coordinates hundreds of orders of magnitude below the extent are the same near and far") {
  // All numbers but -13 and larger ones underflow in the host's far box.
  const SeedArray seeds{
      3,
      {-7.625,   4.5, 11.25, -8.5, -8.5, -8.5,   -8.5,    -8.5, 7.625,    -12.375, -12.5, -13,
       4.8e-312, -13, -13,   -13,  -13,  -10.25, -12.875, -13,  1.5e-309, 3e-315,  -13,   -13},
      std::vector<double>(8, -13)};
  for (const Precision precision : {Precision::float64, Precision::float32}) {
    Options options;
    options.precision = precision;
    const Dual dual = regular_triangulation(Device::choose(), seeds.view(), options);
    CHECK(dual.size() > 0);
    CHECK(facet_faults(dual) == 0);
  }
}

TEST_CASE("seeds too far apart, or too small, are refused by their size") {
  const auto triangulate = [](double size) {
    const std::vector<double> positions{0, 0, size, 0, 0, size, size, size};
    return regular_triangulation(Device::choose(), {2, positions, {}}).size();
  };
  for (const double size : {1e-99, 1e75}) CHECK(triangulate(size) == 2);
  for (const double size : {1e-101, 1e90, 1e308})
    CHECK_THROWS_WITH_AS(triangulate(size), doctest::Contains("a triangulation needs coordinates"), Error);
}

TEST_CASE("too few seeds, or seeds that do not span the space, have no simplices") {
  for (const int dimension : {2, 3}) {
    const Device device = Device::choose();
    CHECK(regular_triangulation(device, SeedsView{dimension, {}, {}}).size() == 0);
    SeedArray line;
    line.dimension = dimension;
    for (int i = 0; i < 20; ++i) {
      for (int k = 0; k < dimension; ++k) line.positions.push_back(i * (k + 1));
      line.weights.push_back(i % 3);
    }
    CHECK(regular_triangulation(device, line.view()).size() == 0);
    const SeedArray same{dimension, std::vector<double>(static_cast<std::size_t>(9 * dimension), 0.5),
                         std::vector<double>(9, 1)};
    CHECK(regular_triangulation(device, same.view()).size() == 0);
  }
  CHECK_THROWS_AS(regular_triangulation(Device::choose(), SeedsView{4, {}, {}}), Error);
}
