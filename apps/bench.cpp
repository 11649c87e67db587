// powercell bench: the speed of devices, next to their arithmetic and memory rates.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <powercell/seeds.hpp>

#include "apps/bench/comparison.hpp"
#include "apps/bench/csv.hpp"
#include "apps/bench/plot.hpp"
#include "apps/bench/run.hpp"
#include "apps/bench/table.hpp"
#include "apps/io/atomic_file.hpp"
#include "apps/io/read/file.hpp"
#include "apps/number_checks.hpp"
#include "apps/option_words.hpp"
#include "apps/outputs.hpp"
#include "apps/report.hpp"

namespace powercell::app {
namespace {

int fail(const std::string& message) {
  fmt::print(stderr, "powercell: error: {}\n", message);
  return 1;
}

// Why a rate that is too low may be chance; empty if nothing says so.
std::string doubt_of(const Ratio& ratio, const SavedRecord& now, const SavedRecord& then, double limit) {
  constexpr const char* advice = ": measure again, on a machine that does nothing else";
  if (ratio.value * (1 + ratio.scatter) >= limit)
    return fmt::format("the runs of both scatter by {:.0f} %, too much to tell{} or with a larger --repeat",
                       100 * ratio.scatter, advice);
  for (const SavedRecord* record : {&now, &then})
    if (const std::string busy = busy_text(record->processors, record->others); !busy.empty())
      return fmt::format("while {} was measured, {}{}", record->path.empty() ? "it" : record->path, busy,
                         advice);
  return {};
}

// Prints the comparison. Exit code.
int conclude_comparison(const BenchArguments& arguments, const SavedRecord& now, const SavedRecord& then,
                        const std::vector<BenchRatio>& ratios) {
  if (arguments.talk()) fmt::print("{}", comparison(now, then, ratios));
  const auto worst = std::min_element(ratios.begin(), ratios.end(), [](const auto& a, const auto& b) {
    return a.least().value < b.least().value;
  });
  const double least = worst->least().value;
  if (least >= arguments.fail_below) return 0;
  const std::string doubt = doubt_of(worst->least(), now, then, arguments.fail_below);
  return fail(fmt::format("{}: {:.3f} of the rate in {}, below --fail-below {}{}", worst->now->title(), least,
                          then.path, arguments.fail_below, doubt.empty() ? "" : "; but " + doubt));
}

int compare_with_earlier(const BenchArguments& arguments, const BenchRecord& record,
                         const SavedRecord& then) {
  const SavedRecord now = saved(record, "");
  const std::vector<BenchRatio> ratios = same_rows(now, then);
  if (ratios.empty())
    return fail(
        fmt::format("{} has no row of the same device, domain, precision and number of seeds", then.path));
  if (arguments.talk()) fmt::print("\n");
  return conclude_comparison(arguments, now, then, ratios);
}

int compare_files(const BenchArguments& arguments) {
  const SavedRecord then = read_record(arguments.compare_files[0]),
                    now = read_record(arguments.compare_files[1]);
  const std::vector<BenchRatio> ratios = alike_rows(now, then);
  if (ratios.empty())
    return fail(fmt::format("{} and {} have no row of the same domain and precision", then.path, now.path));
  return conclude_comparison(arguments, now, then, ratios);
}

int conclude(const BenchArguments& arguments, const BenchRecord& record,
             const std::optional<SavedRecord>& earlier) {
  if (arguments.talk()) {
    fmt::print("{} row{} in {:.0f} s; {}\n", record.rows.size(), record.rows.size() == 1 ? "" : "s",
               record.seconds,
               record.failures() ? fmt::format("{} FAILED", record.failures())
                                 : "the measures of every run sum to the domain's");
    fmt::print("{}{}", scatter_notes(record), headline(record));
    if (const std::string devices = comparison_of_devices(saved(record, "")); !devices.empty())
      fmt::print("\n{}", devices);
  }
  const int compared = earlier ? compare_with_earlier(arguments, record, *earlier) : 0;
  if (const std::string failure = record.failure(); !failure.empty()) return fail(failure);
  return compared;
}

// Called before the first OpenCL call: drivers read these variables once.
void disable_caches() {
  setenv("POWERCELL_CACHE", "never", 1);
  setenv("POCL_KERNEL_CACHE", "0", 1);
  setenv("CUDA_CACHE_DISABLE", "1", 1);
}

/// \throw WrongUsage for options that choose what to measure, where nothing is measured
void refuse_to_measure(const CLI::App& command) {
  for (const char* option :
       {"--device", "--domain", "--precision", "--n", "--repeat", "--quick", "--cold", "--json", "--csv",
        "--plot", "--describe", "--neighbors", "--decisions", "--certify", "--threads"})
    if (command.count(option) > 0)
      throw WrongUsage(fmt::format("--compare with two files measures nothing; leave {} out", option));
}

int run(const BenchArguments& arguments, const CLI::App& command) {
  if (arguments.compare_files.size() == 2) {
    refuse_to_measure(command);
    return compare_files(arguments);
  }
  if (arguments.cold) disable_caches();
  // Unreadable and unwritable files are refused before the benchmark, which takes a minute.
  std::optional<SavedRecord> earlier;
  if (!arguments.compare_files.empty()) earlier = read_record(arguments.compare_files.front());
  check_writable({}, {arguments.json_file, arguments.csv_file, arguments.plot_file}, false);

  const BenchRecord record = run_bench(arguments, earlier ? &*earlier : nullptr);
  if (!arguments.json_file.empty()) {
    io::AtomicFile file(arguments.json_file);
    file.write(json_text(as_json(record)) + "\n");
    file.commit();
  }
  if (!arguments.csv_file.empty()) write_csv(arguments.csv_file, record);
  if (!arguments.plot_file.empty()) write_plot(arguments.plot_file, record);
  return conclude(arguments, record, earlier);
}

constexpr const char* bench_examples =
    R"(Columns: seeds; cells per second for measures alone and for measures with adjacency, from seeds in
host memory to results in host memory, of the best run, each with its scatter: by how much longer than the
best the lower quartile of the runs took. Runs are repeated until a quarter of them are within 5 % of the
best, or the time for the row is over. Numbers of seeds are the same on every device, so that devices can be
compared; the rates of each device over those of the first end the report. Arithmetic and bandwidth: the
work counted for these cells, as a share of the rates that the device reaches in two small kernels (shown
above the table). The work is a model (clipping by the seeds near enough to cut, and integration, with
each number moved once), not a count of executed operations: the time also includes searching and
transfers between host and device. See docs/performance.md. Then seconds to build the kernels (little if
they were cached: see --cold), and from opening the device to the measures of the first 1,000 cells.
Every run is checked: measures that do not sum to the domain's are a failure. The figure at the end is that
of 1,000,000 seeds in the cube (100,000 with --quick), measures alone, in the first precision. A ratio of
--compare has the scatter of both runs beside it, and a ~ where it shows no difference beyond that.
Examples:
  powercell bench                                      every device and precision, some minutes a device
  powercell bench --device gpu --json gpu.json
  powercell bench --quick --domain cube --domain part.mesh --precision float
  powercell bench --json new.json --compare old.json --fail-below 0.9
  powercell bench --device all --csv rates.csv --plot rates.svg
  powercell bench --json mine.json --describe 'workstation, nothing else running'
  powercell bench --compare old.json new.json          two saved files; measures nothing)";

void add_options(CLI::App& command, BenchArguments& arguments) {
  command
      .add_option("--device", arguments.devices,
                  "Part of a device's name, its number P:D, cpu or gpu; may be repeated; of a list with "
                  "commas, or all, each is measured alone")
      ->type_name("DEVICE")
      ->check(known_words({"cpu", "gpu", "all"}))
      ->default_str("POWERCELL_DEVICE, else every device")
      ->expected(1)
      ->take_all();
  command
      .add_option("--domain", arguments.domains,
                  "square, cube, surface (5,120 triangles), volume (13,824 tetrahedra), or a domain as for "
                  "'diagram --domain'; may be repeated")
      ->type_name("FILE|SHAPE")
      ->check(known_words(bench_domain_names()))
      ->default_str("the first four")
      ->expected(1)
      ->take_all();
  command
      .add_option("--precision", arguments.precision, "double, float, or auto: each that the device supports")
      ->check(one_of({"auto", "double", "float"}))
      ->capture_default_str();
  command.add_option("--n", arguments.n, "Seeds")
      ->check(CLI::Range(std::size_t{1}, most_seeds_of_diagram))
      ->default_str("those of --compare, else rows of 10,000 and 100,000, and of 1,000,000 in the cube");
  command.add_option("--repeat", arguments.repeat, "Runs of each kind; the best counts")
      ->check(above_zero())
      ->default_str("until the scatter is small");
  command.add_flag(
      "--quick", arguments.quick,
      "Rows of 10,000 seeds alone, and of 100,000 in the cube, in half a minute for each device");
  command.add_flag(
      "--cold", arguments.cold,
      "Compile the kernels of each row anew, to time it: the caches of powercell, PoCL and NVIDIA's driver "
      "are not used");
  command
      .add_option("--json", arguments.json_file, "Write all figures as JSON; - for stdout without a table")
      ->type_name("FILE")
      ->default_str("none");
  command
      .add_option("--csv", arguments.csv_file,
                  "Write a table with a row for each figure; - for stdout without a table for people")
      ->type_name("FILE.csv")
      ->default_str("none");
  command
      .add_option("--plot", arguments.plot_file,
                  "Draw the rates of rows and transfers, with those of all devices beside each other")
      ->type_name("FILE.svg")
      ->check([](const std::string& path) {
        return io::lower_extension(path) == ".svg" ? std::string() : "a plot is an .svg";
      })
      ->default_str("none");
  command
      .add_option("--describe", arguments.description,
                  "Words to keep in the file of --json, about the machine and so on")
      ->needs("--json")
      ->type_name("TEXT")
      ->default_str("none");
  CLI::Option* compare =
      command
          .add_option(
              "--compare", arguments.compare_files,
              "Print ratios to an earlier file of --json; with a second file those of the second to the "
              "first, and measure nothing")
          ->type_name("FILE")
          ->default_str("none")
          ->expected(1, 2);
  command
      .add_option("--fail-below", arguments.fail_below,
                  "With --compare: exit with 1 if a rate is below this share of the earlier one")
      ->type_name("RATIO")
      ->default_str("none")
      ->check(above_zero())
      ->needs(compare);
  add_engine_options(command, arguments);
  command.add_flag("--quiet", arguments.quiet, "No table; errors are still reported");
}

}  // namespace

Command add_bench(CLI::App& app) {
  auto arguments = std::make_shared<BenchArguments>();
  CLI::App* command = app.add_subcommand("bench", "Measure how fast devices compute");
  add_options(*command, *arguments);
  command->footer(bench_examples);
  return [arguments, command] { return run(*arguments, *command); };
}

}  // namespace powercell::app
