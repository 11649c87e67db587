#include "bench/processes.hpp"

#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "bench/clocks.hpp"

namespace powercell::bench {

namespace {

/// Runs a program without a shell and returns its standard output. \throw std::runtime_error if it fails
std::string run_program(const std::vector<std::string>& words) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("pipe failed");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) {
    std::vector<char*> argv;
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    dup2(ends[1], STDOUT_FILENO);
    close(ends[0]);
    close(ends[1]);
    execv(argv[0], argv.data());
    _exit(127);
  }
  close(ends[1]);
  std::string text;
  char block[4096];
  for (ssize_t got; (got = read(ends[0], block, sizeof block)) > 0;)
    text.append(block, static_cast<std::size_t>(got));
  close(ends[0]);
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error(words[0] + " failed");
  return text;
}

/// The value of a line of /proc/self/status, in bytes.
double status_bytes(const std::string& label) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(label + ":")) return 1024 * std::stod(line.substr(label.size() + 1));
  throw std::runtime_error("/proc/self/status has no " + label);
}

/// Resets the peak of resident memory to the current value.
void reset_peak() {
  malloc_trim(0);
  std::ofstream file("/proc/self/clear_refs");
  file << 5;
  file.close();
  constexpr double slack = 4 << 20;
  if (!file || status_bytes("VmHWM") > status_bytes("VmRSS") + slack)
    throw std::runtime_error("the peak of resident memory cannot be reset on this system");
}

std::string arguments_of(Precision precision) {
  return precision == Precision::float32 ? "--float" : "--double";
}

}  // namespace

void record_memory(const std::string& self, const Work& work, const TurnOptions& options, RecordFile& file) {
  // The contenders of a small work, for their names only.
  Work small = work;
  small.n = 10;
  const Domain domain = domain_of(work.domain);
  const SeedArray seeds = seeds_of(small);
  for (const auto& c : contenders(small, domain, seeds, options)) {
    const std::string text = run_program({self, "memory-child", "--domain", work.domain, "--distribution",
                                          test::name(work.distribution), "--weights",
                                          test::name(work.weights), "--n", std::to_string(work.n), "--ours",
                                          c->stage + ":" + c->provider, arguments_of(options.precision)});
    Record record(options.part, work, *c);
    std::istringstream(text) >> record.bytes_per_seed;
    if (text.empty()) throw std::runtime_error("the process 'memory-child' printed nothing");
    file.add(record);
  }
}

void memory_child(const Work& work, const std::string& way, const TurnOptions& options) {
  const Domain domain = domain_of(work.domain);
  const SeedArray seeds = seeds_of(work);
  TurnOptions one = options;
  const std::string provider = way.substr(way.find(':') + 1);
  const bool ours = provider == "tree" || provider == "flann";
  one.ours = ours ? std::vector{way} : std::vector<std::string>{};
  one.peers = !ours;
  one.only_peers = {provider};
  for (const auto& c : contenders(work, domain, seeds, one)) {
    c->prepare();
    reset_peak();
    const double before = status_bytes("VmRSS");
    c->run();
    const double peak = status_bytes("VmHWM") - before - static_cast<double>(c->output_bytes());
    std::printf("%.1f\n", peak / static_cast<double>(work.n));
    return;
  }
  throw std::invalid_argument("no contender is called '" + way + "'");
}

namespace {

/// Adds the seconds of `rounds` runs. \param run  gets the number of the run
void record_runs(const std::string& stage, int rounds, const std::function<void(int)>& run,
                 const TurnOptions& options, RecordFile& file) {
  const Work work{"box3", Distribution::white, WeightRange::W0, 1000};
  const Domain domain = domain_of(work.domain);
  const SeedArray seeds = seeds_of(work);
  Record record(options.part, work, *our_contender("measures", "tree", options.precision, domain, seeds));
  record.stage = stage;
  for (int k = 0; k < rounds; ++k) {
    const double start = wall_seconds();
    run(k);
    record.seconds.push_back(wall_seconds() - start);
    record.cpu_seconds.push_back(std::numeric_limits<double>::quiet_NaN());
  }
  file.add(record);
}

}  // namespace

void record_start(const std::string& program, const TurnOptions& options, RecordFile& file) {
  run_program({program});
  record_runs(
      "start", 2 * options.rounds, [&](int) { run_program({program}); }, options, file);
}

void record_cold(const std::string& stage, std::vector<std::string> words, const TurnOptions& options,
                 RecordFile& file) {
  namespace fs = std::filesystem;
  constexpr int rounds = 3;
  const fs::path folder = fs::temp_directory_path() / ("powercell_cold_" + std::to_string(getpid()));
  const bool writes = words.back() == "-o";
  record_runs(
      stage, rounds,
      [&](int k) {
        const fs::path here = folder / std::to_string(k);
        fs::create_directories(here / "pocl");
        setenv("POCL_CACHE_DIR", (here / "pocl").c_str(), 1);
        setenv("POWERCELL_CACHE_DIR", (here / "powercell").c_str(), 1);
        std::vector<std::string> all = words;
        if (writes) all.push_back((here / "out").string());
        run_program(all);
      },
      options, file);
  unsetenv("POCL_CACHE_DIR");
  unsetenv("POWERCELL_CACHE_DIR");
  fs::remove_all(folder);
}

}  // namespace powercell::bench
