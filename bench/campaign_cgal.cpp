// campaign_cgal --cells 10000000: compares random diagrams of all dimensions, weights, distributions and
// precisions with CGAL's regular triangulation (exact predicates). Simplices, neighbours and hidden seeds
// must be the same, without a tolerance. Prints a line for each combination; exits 1 on any difference.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <numeric>
#include <powercell/diagram.hpp>

#include "bench/against_cgal.hpp"

using namespace powercell;
using namespace powercell::bench;
using namespace powercell::test;

namespace {

struct Work {
  int dimension;
  Distribution distribution;
  WeightRange weights;
  Precision precision;
};

void compare(Tally& tally, Diagram& diagram, const SeedArray& seeds, const RegularTriangulation& cgal) {
  const auto width = static_cast<std::size_t>(seeds.dimension) + 1;
  const std::vector<Simplex> ours = simplices_of(diagram.dual().simplices, width),
                             theirs = simplices_of(cgal.simplices, width);
  const Inside inside = inside_of(theirs, seeds);
  const auto is_in = [](const std::vector<Simplex>& all, const Simplex& simplex) {
    return std::binary_search(all.begin(), all.end(), simplex);
  };
  for (const Simplex& simplex : inside.simplices) tally.missing_simplices += !is_in(ours, simplex);
  for (const Simplex& simplex : ours) tally.extra_simplices += !is_in(theirs, simplex);
  std::vector<std::uint32_t> all(seeds.size());
  std::iota(all.begin(), all.end(), std::uint32_t{0});
  const Adjacency& adjacency = diagram.adjacency();
  compare_rows(tally, inside, cgal, all, diagram.measures().status, adjacency.offset, adjacency.neighbor);
  tally.simplices += ours.size();
  tally.uncertain += diagram.timings().uncertain;
}

Tally run(const Device& device, const Work& work, std::size_t cells, std::size_t n, std::uint64_t seed) {
  Options options;
  options.precision = work.precision;
  const std::vector<double> low(static_cast<std::size_t>(work.dimension), low_side),
      high(static_cast<std::size_t>(work.dimension), high_side);
  Diagram diagram(device, Domain::box(low, high), options);
  Tally tally;
  Random random(seed);
  while (tally.cells < cells) {
    const SeedArray seeds = random_seeds(work.distribution, work.weights, n, work.dimension, random);
    diagram.set_seeds(seeds.view());
    diagram.compute(true, true);
    compare(tally, diagram, seeds, regular_triangulation(seeds.view()));
  }
  return tally;
}

int run_all(int argc, char** argv) {
  std::size_t cells = 1000000, n = 20000;
  std::uint64_t seed = 1;
  CLI::App app("Random power diagrams against CGAL's regular triangulation, without a tolerance");
  app.add_option("--cells", cells, "In total, over the 36 combinations")->capture_default_str();
  app.add_option("--n", n, "Seeds of a diagram")->capture_default_str();
  app.add_option("--seed", seed, "Of the random numbers")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const Device device = Device::choose();
  std::size_t total = 0, different = 0;
  std::printf("%-3s %-8s %-3s %-7s %10s %10s %10s %8s %10s  differences\n", "dim", "seeds", "w", "numbers",
              "cells", "simplices", "walls", "hidden", "on host");
  for (const int dimension : {2, 3})
    for (const Distribution distribution : {Distribution::white, Distribution::blue, Distribution::cluster})
      for (const WeightRange weights : {WeightRange::W0, WeightRange::W1, WeightRange::W2})
        for (const Precision precision : {Precision::float64, Precision::float32}) {
          const Tally t =
              run(device, {dimension, distribution, weights, precision}, (cells + 35) / 36, n, seed++);
          std::printf("%dD  %-8s %-3s %-7s %10zu %10zu %10zu %8zu %10zu  %zu", dimension,
                      name(distribution).c_str(), name(weights).c_str(),
                      precision == Precision::float64 ? "double" : "float", t.cells, t.simplices, t.walls / 2,
                      t.hidden, t.uncertain, t.differences());
          if (t.differences() > 0)
            std::printf(" (simplices -%zu +%zu, walls -%zu +%zu, hidden %zu; --seed %llu)",
                        t.missing_simplices, t.extra_simplices, t.missing_walls, t.extra_walls,
                        t.wrong_hidden, static_cast<unsigned long long>(seed - 1));
          std::printf("\n");
          std::fflush(stdout);
          total += t.cells;
          different += t.differences();
        }
  std::printf("%zu cells, %zu differences\n", total, different);
  return different == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try { return run_all(argc, argv); } catch (const std::exception& error) {
  std::fprintf(stderr, "campaign_cgal: %s\n", error.what());
  return 2;
}
