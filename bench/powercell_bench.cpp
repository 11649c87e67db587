// Google Benchmark driver. Benchmarks are named stage/domain/distribution/weights/precision/provider/n;
// select with
// --benchmark_filter. Peers run on the same seeds in the same process. Every benchmark checks the sum of the
// measures that it timed. run_matrix.sh compares with the peers, in turns and as tables.
#include <benchmark/benchmark.h>

#include <cmath>
#include <functional>
#include <numeric>
#include <powercell/diagram.hpp>
#include <powercell/version.hpp>

#include "bench/contender.hpp"

using namespace powercell;
using namespace powercell::bench;

namespace {

void check_sum(benchmark::State& state, const std::vector<double>& measures, double domain,
               double tolerance) {
  const double sum = std::accumulate(measures.begin(), measures.end(), 0.0);
  if (!(std::abs(sum - domain) <= tolerance * domain))
    state.SkipWithError(
        ("the sum of the measures is " + std::to_string(sum) + ", not " + std::to_string(domain)).c_str());
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

/// The timed steps, from seeds in host memory to results in host memory.
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
    const Domain domain = domain_of(work.domain);
    const SeedArray seeds = seeds_of(work);
    Diagram diagram(device(), domain, options);
    diagram.set_seeds(seeds.view());
    const double built = device().build_seconds();
    step(diagram, seeds);  // not timed: builds the kernels and grows the buffers
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

void time_peer(benchmark::State& state, const Work& work, const std::string& provider) {
  const double measure = domain_of(work.domain).measure();
  const SeedArray seeds = seeds_of(work);
  const auto peer = peer_contender(provider, work, measure, seeds);
  for (auto _ : state) peer->run();
  if (!(peer->relative_error() <= peer->tolerance()))
    state.SkipWithError("the sum of the measures is not the measure of the domain");
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
        if (neighbors == Neighbors::flann && !has_flann()) continue;
        Options options;
        options.precision = precision;
        options.neighbors = neighbors;
        add(work.name(stage, precision == Precision::float64 ? "double" : "float",
                      neighbors == Neighbors::tree ? "tree" : "flann"),
            [work, options, step](benchmark::State& state) { time_powercell(state, work, options, step); });
      }
}

void add_all() {
  for (const char* domain : {"box2", "box3", "islands", "surface", "tets"})
    for (const Distribution distribution : {Distribution::white, Distribution::blue, Distribution::cluster})
      for (const WeightRange weights : {WeightRange::W0, WeightRange::W1, WeightRange::W2})
        for (const std::size_t n : {1000, 10000, 100000, 1000000}) {
          const Work work{domain, distribution, weights, n};
          for (const std::string& peer : peers_of(domain))
            add(work.name("measures", "double", peer),
                [work, peer](benchmark::State& state) { time_peer(state, work, peer); });
          add_powercell(work);
        }
}

int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::AddCustomContext("device", device().info().name);
  benchmark::AddCustomContext("driver", device().info().driver_version);
  benchmark::AddCustomContext("powercell", version());
  benchmark::AddCustomContext("revision", POWERCELL_REVISION);
  add_all();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
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
