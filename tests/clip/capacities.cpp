#include <doctest/doctest.h>

#include <numeric>

#include "kernels/layout.h"
#include "lib/clip/clipper.hpp"
#include "lib/neighbors/tree_candidates.hpp"
#include "tests/clip/random_scene.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

std::vector<std::uint32_t> all_ranks(const RandomScene& s) {
  std::vector<std::uint32_t> ranks(s.seeds.size());
  std::iota(ranks.begin(), ranks.end(), 0U);
  return ranks;
}

/// Moments by pair in device units.
std::vector<double> read_moments(Clipper& clipper, std::size_t count) {
  std::vector<double> values(count);
  clipper.moments().read(values.data(), count * sizeof(double));
  return values;
}

/// One seed in the middle of `around` seeds on a circle or sphere, whose bisectors all cut its cell.
std::pair<std::vector<double>, std::vector<double>> surrounded(int dimension, int around) {
  std::vector<double> positions(static_cast<std::size_t>(dimension), 0.5);
  const double golden = (std::sqrt(5.0) - 1) / 2, pi = std::acos(-1.0);
  for (int k = 0; k < around; ++k) {
    const double z = dimension == 3 ? 1 - (2 * k + 1.0) / around : 0, r = std::sqrt(1 - z * z);
    const double angle = dimension == 3 ? 2 * pi * golden * k : 2 * pi * k / around;
    positions.push_back(0.5 + 0.4 * r * std::cos(angle));
    positions.push_back(0.5 + 0.4 * r * std::sin(angle));
    if (dimension == 3) positions.push_back(0.5 + 0.4 * z);
  }
  return {positions, std::vector<double>(static_cast<std::size_t>(around) + 1, 0.0)};
}

std::size_t faces_of_middle(const RandomScene& s, const PieceSet& pieces) {
  for (std::size_t rank = 0; rank < s.seeds.size(); ++rank)
    if (s.seeds.input[rank] == 0) return pieces.batches[pieces.batch[rank]].faces(pieces.row[rank]);
  return 0;
}

}  // namespace

TEST_CASE("the host clips as the device does") {
  const auto context = test_context();
  if (!context->info().fp64) return;
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    const RandomScene s(context, dimension, 300, 2.0, false);
    TreeCandidates tree(s.scene);
    Clipper clipper(s.scene, tree, OUTPUT_MOMENTS | OUTPUT_WALLS | OUTPUT_GEOMETRY);
    const auto ranks = all_ranks(s);
    const std::vector<std::uint32_t> regions(ranks.size(), 0);
    const PieceSet pieces = clipper.clip(ranks, regions);
    const std::size_t stride = 2 + static_cast<std::size_t>(dimension);
    const auto moments = read_moments(clipper, ranks.size() * stride);
    const HostScene host = make_host_scene(s.scene);
    const std::unique_ptr<HostClipper> on_host = HostClipper::make(host, false);
    PieceBatch rows;
    std::vector<double> moment(stride);
    for (const std::uint32_t rank : ranks) {
      CAPTURE(rank);
      const int status = on_host->clip(rank, 0, moment, rows);
      REQUIRE(static_cast<int>(pieces.status[rank]) == status);
      for (std::size_t k = 0; k < stride; ++k)
        CHECK(moments[rank * stride + k] == doctest::Approx(moment[k]).epsilon(1e-10));
      CHECK(pieces.batches[pieces.batch[rank]].faces(pieces.row[rank]) == rows.faces(rank));
    }
  }
}

TEST_CASE("cells with any number of faces are clipped completely") {
  const auto context = test_context();
  if (!context->info().fp64) return;
  struct Case {
    int dimension, around;
    bool on_host;
  };
  // More faces than the first capacity, than the second, than 255, and than the host's first try.
  for (const Case c : {Case{2, 50, false}, Case{2, 200, true}, Case{2, 1500, true}, Case{3, 60, false},
                       Case{3, 300, true}, Case{3, 1200, true}}) {
    CAPTURE(c.dimension);
    CAPTURE(c.around);
    const RandomScene s(context, c.dimension, surrounded(c.dimension, c.around), false);
    TreeCandidates tree(s.scene);
    Clipper clipper(s.scene, tree, OUTPUT_MOMENTS | OUTPUT_WALLS, {.exact = false});
    const auto ranks = all_ranks(s);
    const PieceSet pieces = clipper.clip(ranks, std::vector<std::uint32_t>(ranks.size(), 0));
    CHECK(faces_of_middle(s, pieces) == static_cast<std::size_t>(c.around));
    CHECK((clipper.statistics().on_host > 0) == c.on_host);
    CHECK(clipper.statistics().retried > 0);
    const std::size_t stride = 2 + static_cast<std::size_t>(c.dimension);
    const auto moments = read_moments(clipper, ranks.size() * stride);
    double total = 0;
    for (const std::uint32_t rank : ranks) total += moments[rank * stride];
    CHECK(total / std::pow(s.scene.frame().scale, c.dimension) == doctest::Approx(1.0).epsilon(1e-13));
  }
}
