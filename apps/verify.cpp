// powercell verify: checks a device, a diagram of given files, or a saved diagram against the laws.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>

#include "apps/common.hpp"
#include "apps/inputs.hpp"
#include "apps/interrupt.hpp"
#include "apps/io/read/domain.hpp"
#include "apps/number_checks.hpp"
#include "apps/progress.hpp"
#include "apps/report.hpp"
#include "apps/saved.hpp"

namespace powercell::app {
namespace {

struct VerifyArguments : CommonOptions, InputArguments {
  std::string file;
  std::size_t count = 2000;
  std::size_t samples = 1000;
  std::uint64_t random_seed = 1;
};

// Fractions of the stage.
struct Span {
  double from, to;
};

// The laws of one diagram under a title such as "sphere, equal weights".
struct Checked {
  std::string title;
  std::vector<LawCheck> laws;
};

bool passed(const Checked& checked) {
  return std::all_of(checked.laws.begin(), checked.laws.end(),
                     [](const LawCheck& law) { return law.passed; });
}

// Random positions in a box slightly larger than the domain's, so that some seeds lie outside.
std::vector<double> random_positions(const Domain& domain, std::size_t count, std::mt19937_64& random) {
  const auto low = domain.low(), high = domain.high();
  std::uniform_real_distribution<double> unit(-0.02, 1.02);
  std::vector<double> positions;
  for (std::size_t i = 0; i < count; ++i)
    for (int k = 0; k < domain.dimension(); ++k)
      positions.push_back(low[k] + unit(random) * (high[k] - low[k]));
  return positions;
}

// Weights of either sign, over a range of `spread` squares of the mean spacing; with 4 about half of the
// seeds are hidden.
std::vector<double> random_weights(const Domain& domain, std::size_t count, double spread,
                                   std::mt19937_64& random) {
  const double spacing =
      std::pow(domain.measure() / static_cast<double>(count), 1.0 / domain.cell_dimension());
  std::uniform_real_distribution<double> weight(-0.5, 0.5);
  std::vector<double> weights(count);
  for (double& w : weights) w = spread * spacing * spacing * weight(random);
  return weights;
}

void print(const Checked& checked, bool quiet) {
  if (quiet) return;
  fmt::print("{}\n", checked.title);
  for (const LawCheck& law : checked.laws) {
    fmt::print("  {}  {:<58}  {:9.2e}  (allowed {:.1e})\n", law.passed ? "ok  " : "FAIL", law.law, law.value,
               law.tolerance);
    if (!law.passed && !law.detail.empty()) fmt::print("        {}\n", law.detail);
  }
}

constexpr const char* checking = "checking";

// Checks one diagram, in the current part of the stage, and prints the laws.
Checked check(const VerifyArguments& arguments, const Device& device, const Domain& domain,
              const SeedsView& seeds, std::string title, Span part, Progress& progress) {
  Checked checked{std::move(title), {}};
  compute([&] {
    const double computed = 0.5 * (part.from + part.to);
    progress.part(part.from, computed);
    Diagram diagram(device, domain, library_options(arguments, progress));
    diagram.set_seeds(seeds);
    diagram.compute(true, true);
    progress.part(computed, part.to);
    checked.laws = verify(diagram, seeds, {arguments.samples, arguments.random_seed, progress.callback()});
  });
  progress.aside([&] { print(checked, arguments.silent()); });
  return checked;
}

std::vector<Checked> check_device(const VerifyArguments& arguments, const Device& device,
                                  Progress& progress) {
  constexpr double diagrams = 9;
  std::vector<Checked> all;
  std::mt19937_64 random(arguments.random_seed);
  for (const char* shape : {"square", "cube", "sphere"}) {
    const Domain domain = io::read_domain(shape).domain;
    for (const auto& [name, spread] : {std::pair{"equal weights", 0.0}, std::pair{"weights", 0.5},
                                       std::pair{"weights that hide many", 4.0}}) {
      const std::vector<double> positions = random_positions(domain, arguments.count, random);
      const std::vector<double> weights = random_weights(domain, arguments.count, spread, random);
      const auto done = static_cast<double>(all.size());
      all.push_back(check(arguments, device, domain, {domain.dimension(), positions, weights},
                          fmt::format("{}, {} random seeds, {}", shape, with_commas(arguments.count), name),
                          {done / diagrams, (done + 1) / diagrams}, progress));
    }
  }
  return all;
}

std::vector<Checked> check_files(const VerifyArguments& arguments, const Device& device, const Inputs& inputs,
                                 Progress& progress) {
  print_notes(inputs.domain.domain.notes(), arguments.domain, arguments, progress);
  if (!arguments.silent())
    progress.aside([&] {
      for (const std::string& note : inputs.notes) fmt::print("{}\n", note);
    });
  return {check(arguments, device, inputs.domain.domain, inputs.seeds.view(),
                fmt::format("{} with {}", arguments.domain, arguments.seeds), {0, 1}, progress)};
}

std::vector<Checked> check_saved_file(const VerifyArguments& arguments, Progress& progress) {
  const Precision precision = arguments.precision == "float" ? Precision::float32 : Precision::float64;
  const SavedFile saved = read_saved(arguments.file);
  progress.begin(checking);
  Checked checked{arguments.file, check_saved(saved, precision, {arguments.samples, arguments.random_seed})};
  progress.aside([&] { print(checked, arguments.silent()); });
  return {std::move(checked)};
}

nlohmann::json as_json(const std::vector<Checked>& all) {
  nlohmann::json list = nlohmann::json::array();
  for (const Checked& checked : all) {
    nlohmann::json laws = nlohmann::json::array();
    for (const LawCheck& law : checked.laws)
      laws.push_back({{"law", law.law},
                      {"passed", law.passed},
                      {"value", law.value},
                      {"tolerance", law.tolerance},
                      {"detail", law.detail}});
    list.push_back({{"diagram", checked.title}, {"passed", passed(checked)}, {"laws", laws}});
  }
  return list;
}

int conclude(const VerifyArguments& arguments, const std::string& subject, const std::vector<Checked>& all,
             Progress& progress) {
  progress.finish();
  const bool good = std::all_of(all.begin(), all.end(), passed);
  if (arguments.json)
    fmt::print("{}\n", json_text({{"subject", subject},
                                  {"passed", good},
                                  {"checks", as_json(all)},
                                  {"version", version()},
                                  {"seconds",
                                   {{"read", progress.seconds(stage::reading)},
                                    {"open", progress.seconds(stage::opening)},
                                    {"check", progress.seconds(checking)},
                                    {"build", progress.build()},
                                    {"run", progress.run()}}}}));
  else if (!arguments.quiet)
    fmt::print("{}: {}; {:.1f} s{}\n", subject, good ? "all laws hold" : "SOME LAWS ARE BROKEN",
               progress.seconds(checking), building_note(progress.build()));
  return good ? 0 : 1;
}

int run(const VerifyArguments& arguments) {
  if (!arguments.file.empty() && !(arguments.domain + arguments.seeds).empty())
    throw WrongUsage("give either a saved diagram or --domain and --seeds");
  if (arguments.domain.empty() != arguments.seeds.empty())
    throw WrongUsage(
        "--domain and --seeds go together: give both, or neither to check "
        "the device");
  Progress progress({{stage::reading, 3}, {stage::opening, 2}, {checking, 95}}, arguments.silent());
  if (!arguments.file.empty())
    return conclude(arguments, arguments.file, check_saved_file(arguments, progress), progress);
  std::optional<Inputs> inputs;
  if (!arguments.domain.empty()) inputs = read_inputs(arguments);
  progress.begin(stage::opening);
  const Device device = open_single_device(arguments);
  progress.begin(checking);
  return conclude(
      arguments, device.info().name,
      inputs ? check_files(arguments, device, *inputs, progress) : check_device(arguments, device, progress),
      progress);
}

}  // namespace

Command add_verify(CLI::App& app) {
  auto arguments = std::make_shared<VerifyArguments>();
  CLI::App* command =
      app.add_subcommand("verify", "Check a device or a saved diagram against the laws of power diagrams");
  command
      ->add_option("FILE", arguments->file,
                   "A diagram saved by 'diagram -o FILE.json'; --precision is that of its computation")
      ->type_name("FILE")
      ->default_str("none; the device is checked");
  add_inputs(*command, *arguments, false);
  command
      ->add_option("--count", arguments->count, "Number of random seeds in each diagram that checks a device")
      ->check(above_zero())
      ->capture_default_str();
  command->add_option("--samples", arguments->samples, "Number of random points at which all seeds are tried")
      ->capture_default_str();
  command->add_option("--random-seed", arguments->random_seed, "Seed of all random numbers")
      ->capture_default_str();
  add_common_options(*command, *arguments);
  command->footer(
      "Examples:\n"
      "  powercell verify                                     the default device\n"
      "  powercell verify --device gpu --precision float --count 100000\n"
      "  powercell verify --domain part.mesh --seeds grains.txt\n"
      "  powercell verify cells.json                          a saved diagram\n"
      "Exits with 1 if a law is broken.");
  return [arguments] { return run(*arguments); };
}

}  // namespace powercell::app
