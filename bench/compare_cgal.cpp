// compare_cgal --n 100000 --dim 3 --weights W1: compares one large random diagram in the unit box with CGAL
// (adjacency, hidden seeds) and voro++ (volumes). Prints the numbers of differences; exits 1 on any.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <map>
#include <powercell/diagram.hpp>

#include "bench/clocks.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/cgal.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/voro.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// A wall or cell below this fraction of the mean one may be missing or extra: rounding decides.
constexpr double negligible = 1e-12;

struct Arguments {
  std::size_t n = 100000;
  int dimension = 3;
  WeightRange weights = WeightRange::W1;
  Distribution distribution = Distribution::white;
  Neighbors neighbors = Neighbors::automatic;
  Precision precision = Precision::float64;
  std::uint64_t seed = 1;
};

Arguments parse(int argc, char** argv) {
  Arguments a;
  CLI::App app("Compares a random power diagram in the unit box with CGAL and voro++");
  const std::map<std::string, WeightRange> ranges{
      {"W0", WeightRange::W0}, {"W1", WeightRange::W1}, {"W2", WeightRange::W2}};
  const std::map<std::string, Distribution> distributions{
      {"white", Distribution::white}, {"blue", Distribution::blue}, {"cluster", Distribution::cluster}};
  const std::map<std::string, Neighbors> providers{{"tree", Neighbors::tree}, {"flann", Neighbors::flann}};
  app.add_option("--n", a.n, "number of seeds")->capture_default_str();
  app.add_option("--dim", a.dimension, "2 or 3")->check(CLI::IsMember({2, 3}))->capture_default_str();
  app.add_option("--weights", a.weights, "W0, W1 or W2")->transform(CLI::CheckedTransformer(ranges));
  app.add_option("--distribution", a.distribution, "white, blue or cluster")
      ->transform(CLI::CheckedTransformer(distributions));
  app.add_option("--neighbors", a.neighbors, "tree or flann")->transform(CLI::CheckedTransformer(providers));
  app.add_option("--precision", a.precision, "float64 or float32")
      ->transform(CLI::CheckedTransformer(std::map<std::string, Precision>{{"float64", Precision::float64},
                                                                           {"float32", Precision::float32}}));
  app.add_option("--seed", a.seed, "of the random numbers")->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));
  }
  return a;
}

struct Counts {
  std::size_t missing = 0;   ///< walls of CGAL that the diagram lacks
  std::size_t extra = 0;     ///< walls that CGAL lacks
  std::size_t optional = 0;  ///< walls and cells of one side only, but negligible
  std::size_t hidden = 0;    ///< seeds hidden on one side only
  std::size_t volumes = 0;   ///< cells that differ from voro++'s by more than its accuracy, 1e-7 of the mean
  double worst_wall = 0;     ///< largest difference of a wall, relative to the mean wall
  double worst_mass = 0;     ///< largest difference of a cell, relative to the mean cell
  double worst_voro = 0;
  std::size_t total() const { return missing + extra + hidden + volumes; }
};

void compare_walls(Counts& counts, const Adjacency& adjacency, const ReferenceDiagram& reference,
                   double mean) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> ours;
  for (std::uint32_t i = 0; i + 1 < adjacency.offset.size(); ++i)
    for (std::uint64_t k = adjacency.offset[i]; k < adjacency.offset[i + 1]; ++k)
      ours[{i, adjacency.neighbor[k]}] = adjacency.wall[k];
  for (const auto& [pair, measure] : reference.wall) {
    const auto found = ours.find(pair);
    const double there = found == ours.end() ? 0 : found->second, size = static_cast<double>(measure) / mean;
    counts.worst_wall = std::max(counts.worst_wall, std::abs(there / mean - size));
    if (found == ours.end()) ++(size > negligible ? counts.missing : counts.optional);
  }
  for (const auto& [pair, measure] : ours)
    if (!reference.wall.count(pair)) ++(measure / mean > negligible ? counts.extra : counts.optional);
}

void compare_cells(Counts& counts, const Measures& measures, const ReferenceDiagram& reference,
                   const std::vector<double>& voro) {
  const double mean = 1.0 / static_cast<double>(measures.mass.size());
  for (std::size_t i = 0; i < measures.mass.size(); ++i) {
    const double theirs = static_cast<double>(reference.mass[i]);
    counts.worst_mass = std::max(counts.worst_mass, std::abs(measures.mass[i] - theirs) / mean);
    if ((measures.status[i] == SeedStatus::hidden) != (reference.status[i] == SeedStatus::hidden))
      ++(std::max(measures.mass[i], theirs) > negligible * mean ? counts.hidden : counts.optional);
    if (voro.empty()) continue;
    const double off = std::abs(measures.mass[i] - voro[i]) / mean;
    counts.worst_voro = std::max(counts.worst_voro, off);
    if (!(off <= 1e-7)) ++counts.volumes;
  }
}

double mean_wall(const ReferenceDiagram& reference) {
  Real sum = 0;
  for (const auto& entry : reference.wall) sum += entry.second;
  return reference.wall.empty() ? 1 : static_cast<double>(sum / static_cast<Real>(reference.wall.size()));
}

int run(const Arguments& a) {
  Random random(a.seed);
  const SeedArray seeds = random_seeds(a.distribution, a.weights, a.n, a.dimension, random);
  Options options;
  options.precision = a.precision;
  options.neighbors = a.neighbors;
  Diagram diagram(Device::choose(), unit_box(a.dimension), options);
  double start = bench::wall_seconds();
  diagram.set_seeds(seeds.view());
  diagram.measures();
  diagram.adjacency();
  std::printf("powercell: %.2f s on %s\n", bench::wall_seconds() - start,
              diagram.device().info().name.c_str());

  start = bench::wall_seconds();
  const RegularTriangulation cgal = regular_triangulation(seeds.view());
  std::printf("CGAL: %.2f s\n", bench::wall_seconds() - start);
  const ReferenceDiagram reference =
      cut_by_candidates(box_mesh(a.dimension), seeds.view(), cgal.offset, cgal.neighbor, cgal.hidden);
  const std::vector<double> voro = a.dimension == 3 && a.precision == Precision::float64
                                       ? radical_cells(seeds.view(), {}).volume
                                       : std::vector<double>{};

  Counts counts;
  compare_walls(counts, diagram.adjacency(), reference, mean_wall(reference));
  compare_cells(counts, diagram.measures(), reference, voro);
  std::printf("%zu seeds, %dD, %s %s: %zu walls, %zu hidden\n", a.n, a.dimension,
              name(a.distribution).c_str(), name(a.weights).c_str(), reference.wall.size() / 2,
              diagram.measures().count(SeedStatus::hidden));
  std::printf("walls missing %zu, extra %zu, negligible on one side %zu, worst difference %.2g of the mean\n",
              counts.missing, counts.extra, counts.optional, counts.worst_wall);
  std::printf("seeds hidden on one side %zu, worst cell %.2g of the mean\n", counts.hidden,
              counts.worst_mass);
  if (!voro.empty())
    std::printf("cells off voro++'s by more than 1e-7 of the mean: %zu, worst %.2g\n", counts.volumes,
                counts.worst_voro);
  std::printf("sum of the measures off by %.2g\n%s\n", diagram.measures().relative_error(),
              counts.total() == 0 ? "equal" : "DIFFERENT");
  return counts.total() == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(parse(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "compare_cgal: %s\n", error.what());
    return 2;
  }
}
