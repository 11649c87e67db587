// campaign_cgal --cells 10000000: compares random diagrams of all dimensions, weights, distributions and
// precisions with CGAL's regular triangulation (exact predicates). Simplices, neighbours and hidden seeds
// must be the same, without a tolerance. Prints a line for each combination; exits 1 on any difference.
#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <powercell/diagram.hpp>
#include <set>

#include "tests/support/cgal.hpp"
#include "tests/support/generators.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// The domain, with room around the unit box for the corners of cells at the hull.
constexpr double low_side = -1.5, high_side = 2.5;
/// Simplices whose centre is this close to the boundary of the domain are not compared: rounding decides.
constexpr long double side_margin = 1e-9L;

struct Work {
  int dimension;
  Distribution distribution;
  WeightRange weights;
  Precision precision;
};

struct Tally {
  std::size_t cells = 0, simplices = 0, walls = 0, hidden = 0, uncertain = 0;
  std::size_t missing_simplices = 0, extra_simplices = 0, missing_walls = 0, extra_walls = 0,
              wrong_hidden = 0;
  std::size_t differences() const {
    return missing_simplices + extra_simplices + missing_walls + extra_walls + wrong_hidden;
  }
};

using Simplex = std::array<std::uint32_t, 4>;  // ascending; in 2D the last is 2^32 - 1

std::set<Simplex> sorted_simplices(const std::vector<std::uint32_t>& corners, std::size_t width) {
  std::set<Simplex> all;
  for (std::size_t s = 0; s < corners.size(); s += width) {
    Simplex simplex;
    simplex.fill(~std::uint32_t{0});
    std::copy_n(corners.begin() + static_cast<std::ptrdiff_t>(s), width, simplex.begin());
    std::sort(simplex.begin(), simplex.end());
    all.insert(simplex);
  }
  return all;
}

enum class Place { inside, outside, at_side };

/// Where the centre of the simplex, the point of equal power distance to its corners, lies.
Place place_of(const Simplex& simplex, const SeedArray& seeds) {
  const int d = seeds.dimension;
  long double a[3][4];
  for (int r = 0; r < d; ++r) {
    long double offset = static_cast<long double>(seeds.weights[simplex[0]]) -
                         seeds.weights[simplex[static_cast<std::size_t>(r) + 1]];
    for (int k = 0; k < d; ++k) {
      const long double q =
          static_cast<long double>(seeds.coordinate(simplex[static_cast<std::size_t>(r) + 1], k)) -
          seeds.coordinate(simplex[0], k);
      a[r][k] = 2 * q;
      offset += q * q;
    }
    a[r][d] = offset;
  }
  for (int c = 0; c < d; ++c) {
    int best = c;
    for (int r = c + 1; r < d; ++r)
      if (std::abs(a[r][c]) > std::abs(a[best][c])) best = r;
    if (a[best][c] == 0) return Place::outside;
    std::swap(a[best], a[c]);
    for (int r = 0; r < d; ++r) {
      if (r == c) continue;
      const long double factor = a[r][c] / a[c][c];
      for (int k = c; k <= d; ++k) a[r][k] -= factor * a[c][k];
    }
  }
  Place place = Place::inside;
  for (int k = 0; k < d; ++k) {
    const long double x = a[k][d] / a[k][k] + seeds.coordinate(simplex[0], k);
    const long double in = std::min(x - low_side, high_side - x);
    if (in < -side_margin * (1 + std::abs(x))) return Place::outside;
    if (in < side_margin * (1 + std::abs(x))) place = Place::at_side;
  }
  return place;
}

/// The dual must have all of CGAL's simplices with their centre inside the domain and no simplex that CGAL
/// lacks; walls and hidden seeds must agree with these.
void compare(Tally& tally, Diagram& diagram, const SeedArray& seeds, const RegularTriangulation& cgal) {
  const auto width = static_cast<std::size_t>(seeds.dimension) + 1;
  const std::set<Simplex> ours = sorted_simplices(diagram.dual().simplices, width),
                          theirs = sorted_simplices(cgal.simplices, width);
  std::vector<bool> met(seeds.size(), false);
  std::set<std::pair<std::uint32_t, std::uint32_t>> needed;
  for (const Simplex& simplex : theirs) {
    const Place place = place_of(simplex, seeds);
    if (place != Place::inside) continue;
    tally.missing_simplices += ours.count(simplex) == 0;
    for (std::size_t a = 0; a < width; ++a) {
      met[simplex[a]] = true;
      for (std::size_t b = a + 1; b < width; ++b) needed.insert({simplex[a], simplex[b]});
    }
  }
  for (const Simplex& simplex : ours) tally.extra_simplices += theirs.count(simplex) == 0;
  const Adjacency& adjacency = diagram.adjacency();
  for (std::uint32_t i = 0; i < seeds.size(); ++i) {
    const auto row = [](const auto& offset, const auto& neighbor, std::uint32_t k) {
      return std::pair(neighbor.begin() + static_cast<std::ptrdiff_t>(offset[k]),
                       neighbor.begin() + static_cast<std::ptrdiff_t>(offset[k + 1]));
    };
    const auto [begin, end] = row(adjacency.offset, adjacency.neighbor, i);
    const auto [from, to] = row(cgal.offset, cgal.neighbor, i);
    for (auto j = begin; j != end; ++j) tally.extra_walls += !std::binary_search(from, to, *j);
    for (auto j = from; j != to; ++j)
      if (*j > i && needed.count({i, *j}) != 0) tally.missing_walls += !std::binary_search(begin, end, *j);
    const bool hidden = diagram.measures().status[i] == SeedStatus::hidden;
    tally.hidden += hidden;
    tally.wrong_hidden += cgal.hidden[i] != 0 ? !hidden : hidden && met[i];
  }
  tally.cells += seeds.size();
  tally.simplices += ours.size();
  tally.walls += adjacency.neighbor.size() / 2;
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

}  // namespace

int main(int argc, char** argv) {
  std::size_t cells = 1000000, n = 20000;
  std::uint64_t seed = 1;
  CLI::App app("Random power diagrams against CGAL's regular triangulation, without a tolerance");
  app.add_option("--cells", cells, "In total, over the 36 combinations")->capture_default_str();
  app.add_option("--n", n, "Seeds of a diagram")->capture_default_str();
  app.add_option("--seed", seed, "Of the random numbers")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
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
                        precision == Precision::float64 ? "double" : "float", t.cells, t.simplices, t.walls,
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
  } catch (const std::exception& error) {
    std::fprintf(stderr, "campaign_cgal: %s\n", error.what());
    return 2;
  }
}
