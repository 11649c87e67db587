#include "tests/update/loops.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <powercell/diagram.hpp>

#include "tests/support/domains.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/setups.hpp"

namespace powercell::test {
namespace {

/// In means. In the plane the ends of walls between lines that are nearly parallel are less certain than
/// areas.
constexpr double most_difference = 1e-12, most_wall_difference = 1e-9;

Domain random_domain(int dimension, Random& random) {
  if (dimension == 2 && random.index(4) == 0)
    return Domain::polygon(
        std::vector{PolygonPart{Ring{{0.1, 0}, {0.9, 0.1}, {1, 0.7}, {0.6, 1}, {0, 0.5}}, {}}});
  std::vector<double> low, high;
  for (int k = 0; k < dimension; ++k) {
    low.push_back(random.index(2) == 0 ? 0 : random.uniform(-0.2, 0.3));
    high.push_back(random.index(2) == 0 ? 1 : random.uniform(0.6, 1.4));
  }
  return Domain::box(low, high);
}

struct Work {
  SeedArray seeds;
  double h;             ///< their spacing
  double move, change;  ///< steps of a place and a weight, in h and h^2
};

Work random_work(int dimension, std::size_t most_seeds, Random& random) {
  Work work;
  const auto n =
      static_cast<std::size_t>(std::exp(random.uniform(0, std::log(static_cast<double>(most_seeds) + 1))));
  const Distribution distributions[] = {Distribution::white, Distribution::blue, Distribution::cluster};
  const WeightRange ranges[] = {WeightRange::W0, WeightRange::W1, WeightRange::W2};
  const WeightRange range = ranges[random.index(3)];
  work.h = spacing(1, std::max<std::size_t>(n, 1), dimension);
  if (random.index(12) == 0) {
    work.seeds = grid(1 + static_cast<int>(std::pow(static_cast<double>(n), 1.0 / dimension)), dimension);
  } else {
    Box box;
    if (random.index(4) == 0)
      for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = -0.5;
        box.high[k] = 1.5;
      }
    work.seeds = random_seeds(distributions[random.index(3)], range, std::max<std::size_t>(n, 1), dimension,
                              random, box);
  }
  const double steps[] = {0, 1e-6, 1e-3, 1e-2, 0.1, 0.5};
  work.move = steps[random.index(6)];
  work.change = steps[random.index(6)];
  if (random.index(10) == 0) work.change = 20;  // hides most seeds
  return work;
}

/// One step of the loop. \return whether places have changed
bool step(Work& work, Random& random) {
  SeedArray& seeds = work.seeds;
  const std::size_t kind = random.index(10);
  const bool moves = work.move > 0 && kind != 0;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    if (moves)
      for (int k = 0; k < seeds.dimension; ++k)
        seeds.coordinate(i, k) += work.move * work.h * random.uniform(-1, 1);
    seeds.weights[i] += work.change * work.h * work.h * random.uniform(-1, 1);
  }
  const std::size_t some = random.index(seeds.size()), other = random.index(seeds.size());
  if (kind == 1) seeds.weights[some] += work.h * work.h * 9;  // hides its neighbours
  if (kind == 2) seeds.weights[some] -= work.h * work.h * 9;  // is hidden
  if (kind == 3) std::fill(seeds.weights.begin(), seeds.weights.end(), 0.0);
  if (kind == 4)
    for (int k = 0; k < seeds.dimension; ++k) seeds.coordinate(some, k) = random.uniform(-0.2, 1.2);
  if (kind == 5 && random.index(4) == 0)  // a duplicate
    for (int k = 0; k < seeds.dimension; ++k) seeds.coordinate(some, k) = seeds.coordinate(other, k);
  return moves || kind == 4 || kind == 5;
}

/// Compares two diagrams. \return what is different first, or nothing
std::string compare(Diagram& kept, Diagram& fresh, LoopTally& tally) {
  const Measures &a = kept.measures(), &b = fresh.measures();
  for (std::size_t i = 0; i < a.status.size(); ++i)
    if (a.status[i] != b.status[i])
      return "the status of seed " + std::to_string(i) + ", " +
             std::to_string(static_cast<int>(a.status[i])) + " with mass " + std::to_string(a.mass[i]) +
             " instead of " + std::to_string(static_cast<int>(b.status[i])) + " with " +
             std::to_string(b.mass[i]);
  const Adjacency &c = kept.adjacency(), &d = fresh.adjacency();
  if (c.offset != d.offset || c.neighbor != d.neighbor) return "the adjacency";
  const auto cells = static_cast<double>(std::max<std::size_t>(b.count(SeedStatus::ok), 1));
  const int dimension = b.dimension;
  const double mean = b.domain_measure / cells, length = std::pow(mean, 1.0 / dimension);
  const auto n = static_cast<std::size_t>(dimension);
  for (std::size_t i = 0; i < a.mass.size(); ++i) {
    if (b.status[i] != SeedStatus::ok) continue;
    // Of a cell larger than the mean, of its own. Moments are about the seed, which may be far from the cell.
    const double mass = std::max(mean, b.mass[i]),
                 reach = std::max(length, std::sqrt(b.second_moment[i] / std::max(b.mass[i], 1e-6 * mean)));
    double difference = std::abs(a.mass[i] - b.mass[i]) / mass;
    for (std::size_t k = 0; k < n; ++k)
      difference = std::max(
          difference, std::abs(a.centroid[i * n + k] - b.centroid[i * n + k]) * b.mass[i] / mass / reach);
    difference =
        std::max(difference, std::abs(a.second_moment[i] - b.second_moment[i]) / mass / reach / reach);
    tally.worst_measure = std::max(tally.worst_measure, difference);
    if (difference > most_difference)
      return "the measures of seed " + std::to_string(i) + " by " + std::to_string(difference * 1e15) +
             "e-15";
  }
  for (std::size_t k = 0; k < c.wall.size(); ++k) {
    const double difference =
        std::abs(c.wall[k] - d.wall[k]) / std::max(d.wall[k], std::pow(length, dimension - 1));
    tally.worst_wall = std::max(tally.worst_wall, difference);
    if (difference > most_wall_difference) return "a wall by " + std::to_string(difference * 1e15) + "e-15";
  }
  return "";
}

}  // namespace

void run_loop(std::uint64_t random_seed, std::size_t most_seeds, LoopTally& tally) {
  constexpr int steps = 8;
  Random random(random_seed);
  const int dimension = 2 + static_cast<int>(random.index(2));
  const Domain domain = random_domain(dimension, random);
  Work work = random_work(dimension, most_seeds, random);
  Options options;
  options.threads = 1 + static_cast<int>(random.index(2));
  options.keep_mesh = true;
  Diagram kept(test_device(), domain, options);
  options.keep_mesh = false;
  kept.set_seeds(work.seeds.view());
  kept.measures();
  for (int k = 0; k < steps; ++k) {
    if (step(work, random))
      kept.set_seeds(work.seeds.view());
    else
      kept.set_weights(work.seeds.weights);
    Diagram one(test_device(), domain, options);
    one.set_seeds(work.seeds.view());
    kept.compute(true, false);
    ++tally.updates;
    const std::uint64_t reused = kept.timings().reused;
    tally.cells += work.seeds.size();
    tally.reused += reused;
    tally.from_mesh += reused > 0 ? 1 : 0;
    const std::string what = compare(kept, one, tally);
    if (what.empty()) continue;
    ++tally.different;
    if (tally.different <= 5)
      tally.differences += what + ", random seed " + std::to_string(random_seed) + ", step " +
                           std::to_string(k) + ", " + std::to_string(work.seeds.size()) + " seeds, " +
                           std::to_string(reused) + " reused; ";
  }
}

}  // namespace powercell::test
