// powercell tune: measures the settings of a device, and keeps those that are faster.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/interrupt.hpp"
#include "apps/number_checks.hpp"
#include "apps/option_words.hpp"
#include "apps/report.hpp"
#include "apps/tune/settings.hpp"
#include "apps/tune/tuner.hpp"

namespace powercell::app {
namespace {

using nlohmann::json;

std::string value_text(const TuneStep& step, const Trial& trial) {
  if (step.setting != "all") return with_commas(trial.value);
  return trial.value == 0 ? "before" : "chosen";
}

std::string verdict(const TuneStep& step, std::size_t k) {
  if (!step.trials[k].failure.empty()) return "  cannot run: " + io::one_line(step.trials[k].failure);
  if (k != step.chosen) return "";
  return k == 0 ? "  kept" : "  chosen";
}

// A block of the table: a line for each value, with seconds and scatter for each job.
void print_step(const TuneStep& step) {
  fmt::print("{:<18}{:>10}", step.setting, "");
  for (const std::string& job : step.jobs) fmt::print("  {:>28}", job);
  fmt::print("\n{:<18}{:>10}", "", "seeds");
  for (const std::size_t n : step.seeds) fmt::print("  {:>28}", with_commas(n));
  fmt::print("\n");
  for (std::size_t k = 0; k < step.trials.size(); ++k) {
    fmt::print("{:<18}{:>10}", "", value_text(step, step.trials[k]));
    for (std::size_t j = 0; j < step.trials[k].runs.size(); ++j) {
      const TimedRuns &runs = step.trials[k].runs[j], &first = step.trials[0].runs[j];
      if (runs.seconds.empty()) continue;
      fmt::print("  {:>28}", fmt::format("{:.4g} s +{:.0f} %  {:.2f}", runs.best(), 100 * runs.scatter(),
                                         runs.best() / first.best()));
    }
    fmt::print("{}\n", verdict(step, k));
  }
  std::fflush(stdout);
}

json settings_json(const DeviceSettings& settings) {
  json object;
  for (const Setting& one : all_settings()) object[one.name] = one.get(settings);
  return object;
}

json step_json(const TuneStep& step) {
  json trials = json::array();
  for (const Trial& trial : step.trials) {
    json runs = json::array();
    for (std::size_t j = 0; j < trial.runs.size(); ++j)
      runs.push_back({{"job", step.jobs[j]},
                      {"n", step.seeds[j]},
                      {"seconds", trial.runs[j].seconds},
                      {"scatter", trial.runs[j].scatter()}});
    trials.push_back({{"value", trial.value},
                      {"runs", runs},
                      {"failure", trial.failure.empty() ? json() : json(trial.failure)}});
  }
  return {{"setting", step.setting}, {"trials", trials}, {"chosen", step.trials[step.chosen].value}};
}

json as_json(const TuneRecord& record, const std::string& file, bool written) {
  json steps = json::array();
  for (const TuneStep& step : record.steps) steps.push_back(step_json(step));
  return {{"version", version()},
          {"device", record.device.name},
          {"selector", record.device.selector()},
          {"file", file},
          {"written", written},
          {"defaults", settings_json(record.defaults)},
          {"before", settings_json(record.before)},
          {"chosen", settings_json(record.chosen)},
          {"steps", steps}};
}

int reset(const TuneArguments& arguments) {
  const DeviceInfo device = open_single_device(arguments).info();
  const std::string file = settings_file(device);
  const bool removed = remove_settings(device);
  if (arguments.json)
    fmt::print("{}\n", json_text({{"device", device.name},
                                  {"file", file},
                                  {"removed", removed},
                                  {"settings", settings_json(default_settings(device))}}));
  else if (!arguments.quiet)
    fmt::print("{}: {}\n", device.name,
               removed ? "removed " + file + "; the defaults are used" : "the defaults are used already");
  return 0;
}

struct Kept {
  bool written = false, removed = false;
};

// Keeps what was measured: the defaults need no file.
Kept keep(const TuneRecord& record) {
  if (record.chosen == record.defaults) return {false, remove_settings(record.device)};
  save_settings(record.device, record.chosen);
  return {true, false};
}

std::string conclusion(const TuneRecord& record, const std::string& file, const Kept& kept, bool dry_run) {
  const bool all = record.before == record.defaults;
  std::string changes;
  if (record.chosen == record.before)
    changes = fmt::format("no setting is faster than the {} by more than the runs scatter; {} stand",
                          all ? "defaults" : "settings in use", all ? "the defaults" : "these");
  if (record.chosen == record.defaults)
    return changes + (kept.removed ? fmt::format("; removed {}, which had others", file) : "");
  if (!changes.empty()) changes += ": ";
  const std::size_t start = changes.size();
  for (const Setting& one : all_settings())
    if (one.get(record.chosen) != one.get(record.defaults))
      changes +=
          fmt::format("{}{} = {}", changes.size() == start ? "" : ", ", one.name, one.get(record.chosen));
  return fmt::format("{}; {} {}", changes, dry_run ? "not written because of --dry-run:" : "written to",
                     file);
}

// Where runs scatter much, most differences are lost in it.
std::string scatter_note(const TuneRecord& record) {
  double most = 0;
  for (const TuneStep& step : record.steps)
    for (const Trial& trial : step.trials)
      for (const TimedRuns& runs : trial.runs) most = std::max(most, runs.scatter());
  if (most <= much_scatter) return {};
  return fmt::format(
      "note: some runs scatter by {:.0f} %: something else keeps this machine busy, or its clock changes;\n"
      "      stop that, or raise --repeat\n",
      100 * most);
}

int run(const TuneArguments& arguments) {
  if (arguments.reset && arguments.dry_run)
    throw WrongUsage("--reset removes a file, and --dry-run changes none");
  if (arguments.reset) return reset(arguments);
  bool first = true;
  const TuneRecord record = tune(arguments, [&](const TuneStep& step) {
    if (arguments.silent()) return;
    if (!first) fmt::print("\n");
    first = false;
    print_step(step);
  });
  const std::string file = settings_file(record.device);
  Kept kept;
  compute([&] {
    if (!arguments.dry_run) kept = keep(record);
  });
  if (arguments.json) fmt::print("{}\n", json_text(as_json(record, file, kept.written)));
  if (!arguments.silent())
    fmt::print("\n{}{}: {}\n", scatter_note(record), record.device.name,
               conclusion(record, file, kept, arguments.dry_run));
  return 0;
}

constexpr const char* tune_examples =
    R"(Each block of the table is a setting, each line a value of it, the one in use first: for each job the
seconds of the best run, how much longer the lower quartile took, and the ratio to the first line. A value is
chosen where it is faster by more than both scatter (and 3 %) in some job, and slower by as much in none;
otherwise the one in use is kept. At the end the result is timed against where it began once more: the
defaults, or with --only the settings in use. Every value must give the same bits. The file is read
whenever the device is opened, until its driver or powercell changes. Let the machine do nothing else
meanwhile. See docs/devices.md.
Examples:
  powercell tune --dry-run
  powercell tune --device nvidia
  powercell tune --only group_size,chunk_pairs
  powercell tune --reset)";

}  // namespace

Command add_tune(CLI::App& app) {
  auto arguments = std::make_shared<TuneArguments>();
  CLI::App* command =
      app.add_subcommand("tune", "Measure the settings of a device, and keep the faster ones");
  add_device_option(*command, *arguments);
  command->add_option("--only", arguments->only, "Settings to measure, with commas between")
      ->delimiter(',')
      ->check(one_of(setting_names()))
      ->default_str("all");
  command->add_option("--n", arguments->n, "Seeds of each diagram")
      ->check(CLI::Range(std::size_t{1}, std::size_t{10'000'000}))
      ->default_str("as many as a run of 0.2 seconds takes");
  command
      ->add_option("--repeat", arguments->repeat,
                   "Runs of each value; the best counts, the others show the scatter")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  command->add_flag("--dry-run", arguments->dry_run, "Measure and print, but write no file");
  command->add_flag("--reset", arguments->reset, "Remove the file of the device, and measure nothing");
  add_threads_option(*command, *arguments);
  add_output_options(*command, *arguments);
  command->footer(tune_examples);
  return [arguments] { return run(*arguments); };
}

}  // namespace powercell::app
