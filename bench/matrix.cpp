// Times this library and its peers on the same seeds in one process, in turns, and writes JSON. run_matrix.sh
// and run_goals.sh call it and make tables and plots of the JSON with matrix_table.py, plots.py and goals.py.
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <map>
#include <thread>

#include "bench/processes.hpp"

using namespace powercell;
using namespace powercell::bench;

namespace {

struct Arguments {
  std::vector<std::string> domains{"box2", "box3", "surface", "tets"};
  std::vector<Distribution> distributions{Distribution::white, Distribution::blue, Distribution::cluster};
  std::vector<WeightRange> weights{WeightRange::W0, WeightRange::W1, WeightRange::W2};
  std::vector<std::size_t> n{100000};
  bool no_peers = false, single = false;
  std::string out, tool;
  TurnOptions options;
};

template <class Do>
void for_each_work(const Arguments& a, const Do& work) {
  for (const std::string& domain : a.domains)
    for (const Distribution distribution : a.distributions)
      for (const WeightRange weights : a.weights) work(Work{domain, distribution, weights, 0});
}

void add_works(CLI::App& app, Arguments& a) {
  static const std::map<std::string, Distribution> distributions{
      {"white", Distribution::white}, {"blue", Distribution::blue}, {"cluster", Distribution::cluster}};
  static const std::map<std::string, WeightRange> ranges{
      {"W0", WeightRange::W0}, {"W1", WeightRange::W1}, {"W2", WeightRange::W2}};
  app.add_option("--domain", a.domains, "box2, box3, surface, tets, bracket, gyroid, islands")
      ->check(CLI::IsMember({"box2", "box3", "surface", "tets", "bracket", "gyroid", "islands"}));
  app.add_option("--distribution", a.distributions, "white, blue, cluster")
      ->transform(CLI::CheckedTransformer(distributions));
  app.add_option("--weights", a.weights, "W0, W1, W2")->transform(CLI::CheckedTransformer(ranges));
  app.add_option("--n", a.n, "numbers of seeds")->check(CLI::Range(2, 100000000));
  app.add_option(
      "--ours", a.options.ours,
      "stage:provider; stages measures, adjacency (with measures), weights (as adjacency, but only "
      "the weights change), periodic (as adjacency, of a box); providers tree, flann");
  app.add_option("--peer", a.options.only_peers,
                 "only these peers: cgal, cgal-parallel, voro++, voro++-parallel");
  app.add_flag("--no-peers", a.no_peers, "only this library");
  app.add_flag("--float,!--double", a.single, "precision of this library");
}

void add_turns(CLI::App& app, Arguments& a) {
  app.add_option("--out", a.out, "the JSON file")->required();
  app.add_option("--part", a.options.part, "the part of the report that the results belong to");
  app.add_option("--rounds", a.options.rounds, "the most runs of each")->check(CLI::Range(1, 1000));
  app.add_option("--least-rounds", a.options.least_rounds, "the fewest runs of each, however long they take");
  app.add_option("--seconds", a.options.seconds, "time limit for one work, after which no round is begun");
  app.add_option("--drop", a.options.drop,
                 "leave out contenders that took this many times as long as the best peer at fewer seeds");
}

int run(int argc, char** argv) {
  Arguments a;
  CLI::App app{"Benchmarks of powercell and its peers"};
  app.require_subcommand(1);
  CLI::App* time = app.add_subcommand("time", "seconds of each contender for each work");
  CLI::App* memory = app.add_subcommand("memory", "peak memory of each contender, in fresh processes");
  CLI::App* start = app.add_subcommand(
      "start", "time from start to first result of a fresh process, with full and with empty caches");
  CLI::App* child = app.add_subcommand("memory-child", "one process of 'memory'")->group("");
  for (CLI::App* sub : {time, memory, child}) add_works(*sub, a);
  for (CLI::App* sub : {time, memory, start}) add_turns(*sub, a);
  start->add_option("--tool", a.tool, "the tool, whose demo is timed too");
  CLI11_PARSE(app, argc, argv);
  a.options.peers = !a.no_peers;
  a.options.precision = a.single ? Precision::float32 : Precision::float64;

  // The peers get as many threads as the CPU device has.
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    std::thread::hardware_concurrency());
  if (child->parsed()) {
    const Work work{a.domains.at(0), a.distributions.at(0), a.weights.at(0), a.n.at(0)};
    memory_child(work, a.options.ours.at(0), a.options);
    return 0;
  }
  RecordFile file(a.out);
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  if (time->parsed()) for_each_work(a, [&](const Work& work) { run_series(work, a.n, a.options, file); });
  if (memory->parsed())
    for_each_work(a, [&](Work work) {
      for (const std::size_t n : a.n) {
        work.n = n;
        record_memory(self.string(), work, a.options, file);
      }
    });
  if (start->parsed()) {
    const std::string program = (self.parent_path() / "first_result").string();
    record_start(program, a.options, file);
    record_cold("cold", {program}, a.options, file);
    if (!a.tool.empty()) record_cold("cold demo", {a.tool, "demo", "-o"}, a.options, file);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "powercell_matrix: %s\n", error.what());
    return 2;
  }
}
