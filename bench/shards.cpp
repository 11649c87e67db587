// shards --n 1000000 --shards 64: a diagram of seeds in shards beside that of all seeds. Prints a row a
// distribution and range of weights: rounds, seeds fetched, those of them with a wall, bytes, processor time,
// the least of --repeat times of each, which take turns; and compares the two. Exits 1 if adjacency, statuses
// or measures differ.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "bench/clocks.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/shares.hpp"

using namespace powercell;
using namespace powercell::bench;
using namespace powercell::exchange;
using namespace powercell::test;

namespace {

/// The number of seeds whose status or neighbours differ, and the largest difference of measures over the
/// mean.
struct Difference {
  std::size_t seeds = 0;
  double measure = 0;
};

Difference compare(Diagram& diagram, const Shares& shares, const std::vector<ShardCells>& shards) {
  Difference difference;
  const Measures& measures = diagram.measures();
  const Adjacency& adjacency = diagram.adjacency();
  const double mean = measures.domain_measure / static_cast<double>(diagram.size());
  for (std::size_t s = 0; s < shards.size(); ++s)
    for (std::size_t k = 0; k < shares.ids[s].size(); ++k) {
      const std::size_t i = shares.ids[s][k];
      const ShardCells& cells = shards[s];
      const auto row = [](const auto& from, std::uint64_t begin) {
        return from.begin() + static_cast<std::ptrdiff_t>(begin);
      };
      const bool same =
          cells.measures.status[k] == measures.status[i] &&
          std::equal(row(cells.neighbor, cells.offset[k]), row(cells.neighbor, cells.offset[k + 1]),
                     row(adjacency.neighbor, adjacency.offset[i]),
                     row(adjacency.neighbor, adjacency.offset[i + 1])) &&
          (adjacency.shift.empty() ||
           std::equal(row(cells.shift, cells.offset[k]), row(cells.shift, cells.offset[k + 1]),
                      row(adjacency.shift, adjacency.offset[i]),
                      row(adjacency.shift, adjacency.offset[i + 1])));
      difference.seeds += !same;
      difference.measure = std::max(difference.measure, std::abs(cells.measures.mass[k] - measures.mass[i]) /
                                                            std::max(mean, measures.mass[i]));
    }
  return difference;
}

struct Work {
  Distribution distribution;
  WeightRange weights;
  std::size_t n;
  int dimension, repeat;
  bool periodic;
};

Domain domain_of(const Work& work) {
  const std::array<double, 3> low{0, 0, 0}, high{1, 1, 1};
  const auto d = static_cast<std::size_t>(work.dimension);
  return work.periodic ? Domain::periodic_box(std::span(low).first(d), std::span(high).first(d))
                       : unit_box(work.dimension);
}

/// Processor seconds of a call, or `least` if they are more.
template <class Call>
double least_seconds(double least, const Call& call) {
  const double start = processor_seconds();
  call();
  return std::min(least, processor_seconds() - start);
}

bool run(const Device& device, const Work& work, std::size_t count) {
  const Domain domain = domain_of(work);
  Random random(1);
  const SeedArray seeds = random_seeds(work.distribution, work.weights, work.n, work.dimension, random);
  Diagram diagram(device, domain);
  const auto compute = [&] {
    diagram.set_seeds(seeds.view());
    diagram.compute(true, false);
  };
  if (seeds.size() < 200000) compute();  // kernels are compiled
  const Shares shares = along_curve(seeds, count);
  const std::vector<ShardSeeds> view = shares.view();
  ShardedDiagram sharded;
  double alone = std::numeric_limits<double>::infinity(), spent = alone;
  for (int k = 0; k < work.repeat; ++k) {
    alone = least_seconds(alone, compute);
    spent = least_seconds(spent, [&] { sharded = compute_shards(device, domain, view); });
  }
  const ExchangeReport& r = sharded.report;
  const Difference difference = compare(diagram, shares, sharded.shards);
  const auto n = static_cast<double>(seeds.size());
  std::printf(
      "%-8s %-2s %9zu %6zu %6d %9llu %9llu %6.3f %8.2f %8.1f %8.1f %8.1f %8.1f %8.2f %8.2f %6.2f %6zu "
      "%9.1e\n",
      name(work.distribution).c_str(), name(work.weights).c_str(), seeds.size(), count, r.rounds,
      static_cast<unsigned long long>(r.fetched), static_cast<unsigned long long>(r.neighbors),
      static_cast<double>(r.fetched) / static_cast<double>(r.neighbors), static_cast<double>(r.clipped) / n,
      static_cast<double>(r.coarse_trees) / n, static_cast<double>(r.requests) / n,
      static_cast<double>(r.replies) / n, static_cast<double>(r.ending) / n, alone, spent, spent / alone,
      difference.seeds, difference.measure);
  std::fflush(stdout);
  return difference.seeds == 0 && difference.measure < 1e-13;
}

int run_all(int argc, char** argv) {
  std::size_t n = 100000, count = 64;
  int dimension = 3, repeat = 3;
  bool periodic = false;
  std::vector<std::string> only;
  CLI::App app("Diagrams of seeds in shards");
  app.add_option("--n", n, "Seeds")->capture_default_str();
  app.add_option("--shards", count, "Shards")->capture_default_str();
  app.add_option("--dimension", dimension, "In the unit square (2) or cube (3)")->capture_default_str();
  app.add_flag("--periodic", periodic, "With all axes periodic");
  app.add_option("--only", only, "Cases such as white/W0");
  app.add_option("--repeat", repeat, "Times that each is computed")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const Device device = Device::choose();
  std::printf("%-8s %-2s %9s %6s %6s %9s %9s %6s %8s %8s %8s %8s %8s %8s %8s %6s %6s %9s\n", "seeds", "", "n",
              "shards", "rounds", "fetched", "walls", "ratio", "clipped", "coarse trees", "requests",
              "replies", "ending", "alone s", "shards s", "ratio", "differ", "measure");
  bool good = true;
  for (const Distribution distribution : {Distribution::white, Distribution::blue, Distribution::cluster})
    for (const WeightRange weights : {WeightRange::W0, WeightRange::W1, WeightRange::W2}) {
      const std::string title = name(distribution) + "/" + name(weights);
      if (!only.empty() && std::find(only.begin(), only.end(), title) == only.end()) continue;
      good = run(device, {distribution, weights, n, dimension, repeat, periodic}, count) && good;
    }
  return good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try { return run_all(argc, argv); } catch (const std::exception& error) {
  std::fprintf(stderr, "shards: %s\n", error.what());
  return 1;
}
