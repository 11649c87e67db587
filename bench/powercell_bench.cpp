// Google Benchmark driver. Names: stage/domain/distribution/weights/precision/provider/n, chosen with
// --benchmark_filter. Peers run on the same seeds in the same process. Every benchmark checks the sum of
// the measures that it timed. With --table the results are a markdown table on stdout.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <numeric>
#include <powercell/diagram.hpp>
#include <powercell/version.hpp>

#include "bench/peers.hpp"
#include "bench/table.hpp"
#include "tests/support/domains.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

const Device& device() {
  static const Device chosen = Device::choose();
  return chosen;
}

struct Shape {
  std::string name;
  std::function<Domain()> make;
};

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> list = {
      {"box2", [] { return unit_box(2); }},
      {"box3", [] { return unit_box(3); }},
      {"islands", [] { return Domain::polygon(islands()); }},
      {"torus", [] { return surface_of(torus(200, 80)); }},
      {"cube_tetrahedra",
       [] {
         Random random(7);
         return volume_of(cube_tetrahedra(12, 0.15, random));
       }},
  };
  return list;
}

/// What is computed for what; seeds depend on it alone, so that all ways get the same.
struct Work {
  Shape shape;
  Distribution distribution;
  WeightRange weights;
  std::size_t n;

  std::string name(const std::string& stage, const std::string& precision,
                   const std::string& provider) const {
    return stage + "/" + shape.name + "/" + test::name(distribution) + "/" + test::name(weights) + "/" +
           precision + "/" + provider + "/" + std::to_string(n);
  }
  /// In boxes all seeds lie inside, as voro++ needs it.
  SeedArray seeds(const Domain& domain) const {
    Random random(1);
    if (shape.name == "box2" || shape.name == "box3")
      return random_seeds(distribution, weights, n, domain.dimension(), random);
    return seeds_for(domain, distribution, weights, n, random);
  }
};

void check_sum(benchmark::State& state, const std::vector<double>& measures, double domain,
               double tolerance) {
  const double sum = std::accumulate(measures.begin(), measures.end(), 0.0);
  if (!(std::abs(sum - domain) <= tolerance * domain))
    state.SkipWithError(
        ("the measures sum to " + std::to_string(sum) + ", not " + std::to_string(domain)).c_str());
}

void count_cells(benchmark::State& state, std::size_t n) {
  state.counters["cells/s"] =
      benchmark::Counter(static_cast<double>(n), benchmark::Counter::kIsIterationInvariantRate);
}

void report_parts(benchmark::State& state, const Timings& t) {
  state.counters["prepare_s"] = t.prepare;
  state.counters["pairs_s"] = t.pairs;
  state.counters["neighbors_s"] = t.neighbors;
  state.counters["clip_s"] = t.clip;
  state.counters["collect_s"] = t.collect;
  state.counters["pair_count"] = static_cast<double>(t.pair_count);
  state.counters["retried"] = static_cast<double>(t.retried);
  state.counters["on_host"] = static_cast<double>(t.on_host);
}

using Step = std::function<void(Diagram&, const SeedArray&)>;

/// The steps that are timed; each starts from seeds in host memory and ends with results there.
const std::vector<std::pair<std::string, Step>>& stages() {
  static const std::vector<std::pair<std::string, Step>> list = {
      {"measures", [](Diagram& d, const SeedArray& s) { d.set_seeds(s.view()), d.measures(); }},
      {"weights", [](Diagram& d, const SeedArray& s) { d.set_weights(s.weights), d.measures(); }},
      {"adjacency", [](Diagram& d, const SeedArray& s) { d.set_seeds(s.view()), d.adjacency(); }},
      {"cells", [](Diagram& d, const SeedArray& s) { d.set_seeds(s.view()), d.cells(); }},
      {"dual", [](Diagram& d, const SeedArray& s) { d.set_seeds(s.view()), d.dual(); }},
  };
  return list;
}

void time_powercell(benchmark::State& state, const Work& work, const Options& options, const Step& step) {
  try {
    const Domain domain = work.shape.make();
    const SeedArray seeds = work.seeds(domain);
    Diagram diagram(device(), domain, options);
    diagram.set_seeds(seeds.view());
    const double built = device().build_seconds();
    step(diagram, seeds);  // builds the kernels and grows the buffers, not timed
    state.counters["build_s"] = device().build_seconds() - built;
    Timings timings;
    for (auto _ : state) {
      step(diagram, seeds);
      timings = diagram.timings();
    }
    check_sum(state, diagram.measures().mass, domain.measure(),
              diagram.precision() == Precision::float32 ? 1e-4 : 1e-11);
    count_cells(state, work.n);
    report_parts(state, timings);
  } catch (const Error& error) {
    state.SkipWithError(error.what());
  }
}

using Peer = std::vector<double> (*)(const SeedsView&, const Box&);

void time_peer(benchmark::State& state, const Work& work, Peer peer) {
  const SeedArray seeds = work.seeds(work.shape.make());
  std::vector<double> measures;
  for (auto _ : state) measures = peer(seeds.view(), {});
  check_sum(state, measures, 1, 1e-7);  // CGAL's constructions and voro++'s cuts are not exact
  count_cells(state, work.n);
}

template <class... Args>
void add(const std::string& name, Args... args) {
  benchmark::RegisterBenchmark(name.c_str(), args...)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->MinTime(0.5);
}

void add_powercell(const Work& work) {
  for (const auto& [stage, step] : stages())
    for (const Precision precision : {Precision::float64, Precision::float32})
      for (const Neighbors neighbors : {Neighbors::tree, Neighbors::flann}) {
#ifndef POWERCELL_TEST_FLANN
        if (neighbors == Neighbors::flann) continue;
#endif
        Options options;
        options.precision = precision;
        options.neighbors = neighbors;
        add(work.name(stage, precision == Precision::float64 ? "double" : "float",
                      neighbors == Neighbors::tree ? "tree" : "flann"),
            [work, options, step](benchmark::State& state) { time_powercell(state, work, options, step); });
      }
}

void add_peers(const Work& work) {
  const auto add_peer = [&](const char* provider, Peer peer) {
    add(work.name("measures", "double", provider),
        [work, peer](benchmark::State& state) { time_peer(state, work, peer); });
  };
  if (work.shape.name == "box2") add_peer("cgal", bench::cgal_measures_2d);
  if (work.shape.name != "box3") return;
  add_peer("cgal", bench::cgal_measures_3d);
  add_peer("cgal-parallel", bench::cgal_parallel_measures_3d);
  add_peer("voro++", bench::voro_measures);
}

void add_all() {
  for (const Shape& shape : shapes())
    for (const Distribution distribution : {Distribution::white, Distribution::blue, Distribution::cluster})
      for (const WeightRange weights : {WeightRange::W0, WeightRange::W1, WeightRange::W2})
        for (const std::size_t n : {1000, 10000, 100000, 1000000}) {
          const Work work{shape, distribution, weights, n};
          add_peers(work);
          add_powercell(work);
        }
}

/// Takes `flag` out of the arguments if it is there.
bool take_flag(int& argc, char** argv, const char* flag) {
  for (int k = 1; k < argc; ++k)
    if (std::strcmp(argv[k], flag) == 0) {
      for (; k + 1 < argc; ++k) argv[k] = argv[k + 1];
      --argc;
      return true;
    }
  return false;
}

int run(int argc, char** argv) {
  const bool table = take_flag(argc, argv, "--table");
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::AddCustomContext("device", device().info().name);
  benchmark::AddCustomContext("driver", device().info().driver_version);
  benchmark::AddCustomContext("powercell", version());
  benchmark::AddCustomContext("revision", POWERCELL_REVISION);
  add_all();
  if (!table) {
    benchmark::RunSpecifiedBenchmarks();
    return 0;
  }
  bench::TableReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return reporter.failed() ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "powercell_bench: %s\n", error.what());
    return 2;
  }
}
