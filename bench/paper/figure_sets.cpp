#include <algorithm>
#include <numeric>

#include "bench/paper/figures.hpp"

namespace powercell::paper {

namespace {

/// Locations between a jittered grid and clusters in [0,1]^d, n = per_axis^d. From -1 to 0 the jitter of the
/// grid grows from 0.1 to 2 of its cells (white, by then); from 0 to 1 the part of the seeds in blobs grows
/// to all.
test::SeedArray locations(double clustering, int per_axis, int dimension, test::Random& random) {
  test::SeedArray seeds = test::grid(per_axis, dimension);
  const double jitter = std::max(0.1, 2 + 2 * std::min(0.0, clustering)) / per_axis;
  double centre[6][3], width[6];
  for (int b = 0; b < 6; ++b) {
    for (double& c : centre[b]) c = random.uniform(0.1, 0.9);
    width[b] = random.uniform(0.01, 0.05);
  }
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const std::size_t blob = random.index(6);
    const bool in_blob = random.uniform() < clustering;
    for (int k = 0; k < dimension; ++k) {
      double& x = seeds.coordinate(i, k);
      const double grid = x;
      do
        x = in_blob ? centre[blob][k] + width[blob] * random.normal()
                    : grid + jitter * random.uniform(-0.5, 0.5);
      while (x < 0 || x > 1);
    }
  }
  return seeds;
}

/// Mean distance to the nearest other seed, relative to the densest lattice of as many in the unit box: 1
/// there, about 0.47 (square) and 0.49 (cube) for white seeds, near 0 in clusters.
double uniformity(const test::SeedArray& seeds) {
  const std::size_t n = seeds.size(), d = static_cast<std::size_t>(seeds.dimension);
  std::vector<double> nearest(n, 1e300);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      double s = 0;
      for (std::size_t k = 0; k < d; ++k) {
        const double q = seeds.positions[i * d + k] - seeds.positions[j * d + k];
        s += q * q;
      }
      nearest[i] = std::min(nearest[i], s);
      nearest[j] = std::min(nearest[j], s);
    }
  double sum = 0;
  for (const double s : nearest) sum += std::sqrt(s);
  const double lattice = d == 2 ? std::sqrt(2 / std::sqrt(3.0)) : std::pow(2.0, 1.0 / 6);
  return sum / static_cast<double>(n) / (lattice * test::spacing(1, n, seeds.dimension));
}

}  // namespace

void sets_figure(const Study& study) {
  const int strata = study.quick ? 10 : 50;
  TableFile file(
      study, "figure8",
      std::to_string(strata * strata) +
          " sets a dimension, 1024 seeds in the square, 1000 in the cube; weights uniform in [0, range "
          "h^2]; microseconds of processor time a seed",
      {"domain", "uniformity", "range", "hidden", "flann_us", "tree_us"});
  for (const int dimension : {2, 3}) {
    Trial trial(study.device, test::unit_box(dimension), {tree_way(), list_way()});
    test::Random random(1);
    const int per_axis = dimension == 2 ? 32 : 10;
    for (int a = 0; a < strata; ++a)
      for (int b = 0; b < strata; ++b) {
        const double clustering = 2 * (a + random.uniform()) / strata - 1;
        const double range = 0.02 * std::pow(1000.0, (b + random.uniform()) / strata);
        test::SeedArray seeds = locations(clustering, per_axis, dimension, random);
        const double h = test::spacing(1, seeds.size(), dimension);
        for (double& w : seeds.weights) w = range * h * h * random.uniform();
        const std::vector<Time> times = trial.run(seeds.view(), 2);
        file.row({std::string(dimension == 2 ? "square" : "cube"), uniformity(seeds), range,
                  mean(trial.hidden(), seeds.size()), per_seed(times[1].processor, seeds.size()),
                  per_seed(times[0].processor, seeds.size())});
      }
  }
}

}  // namespace powercell::paper
