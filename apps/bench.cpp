// powercell bench: the speed of devices, next to their arithmetic and memory rates.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <powercell/seeds.hpp>

#include "apps/bench/run.hpp"
#include "apps/bench/table.hpp"
#include "apps/io/atomic_file.hpp"
#include "apps/number_checks.hpp"
#include "apps/report.hpp"

namespace powercell::app {
namespace {

int fail(const std::string& message) {
  fmt::print(stderr, "powercell: error: {}\n", message);
  return 1;
}

// Prints the comparison. Exit code.
int conclude_comparison(const BenchArguments& arguments, const BenchRecord& record,
                        const EarlierRecord& earlier) {
  const std::vector<BenchRatio> ratios = compare(record, earlier);
  if (ratios.empty())
    return fail(
        fmt::format("{} has no row of the same device, domain, precision and number of seeds", earlier.path));
  if (arguments.talk()) fmt::print("\n{}", comparison(record, earlier, ratios));
  const auto worst = std::min_element(ratios.begin(), ratios.end(),
                                      [](const auto& a, const auto& b) { return a.least() < b.least(); });
  if (worst->least() >= arguments.fail_below) return 0;
  return fail(fmt::format("{}: {:.3f} of the rate in {}, below --fail-below {}", worst->row->title(),
                          worst->least(), earlier.path, arguments.fail_below));
}

int conclude(const BenchArguments& arguments, const BenchRecord& record,
             const std::optional<EarlierRecord>& earlier) {
  if (arguments.talk())
    fmt::print("{} row{} in {:.0f} s; {}\n", record.rows.size(), record.rows.size() == 1 ? "" : "s",
               record.seconds,
               record.failures() ? fmt::format("{} FAILED", record.failures())
                                 : "the measures of every run sum to the domain's");
  const int compared = earlier ? conclude_comparison(arguments, record, *earlier) : 0;
  if (const std::string failure = record.failure(); !failure.empty()) return fail(failure);
  return compared;
}

// Called before the first OpenCL call: drivers read these variables once.
void disable_caches() {
  setenv("POWERCELL_CACHE", "never", 1);
  setenv("POCL_KERNEL_CACHE", "0", 1);
  setenv("CUDA_CACHE_DISABLE", "1", 1);
}

int run(const BenchArguments& arguments) {
  if (arguments.cold) disable_caches();
  // Unreadable and unwritable files are refused before the benchmark, which takes a minute.
  std::optional<EarlierRecord> earlier;
  if (!arguments.compare_file.empty()) earlier = read_record(arguments.compare_file);
  std::optional<io::AtomicFile> file;
  if (!arguments.json_file.empty() && arguments.json_file != "-") file.emplace(arguments.json_file);

  const BenchRecord record = run_bench(arguments, earlier ? &*earlier : nullptr);
  const std::string json = json_text(as_json(record)) + "\n";
  if (file) {
    file->write(json);
    file->commit();
  }
  if (arguments.json_file == "-") fmt::print("{}", json);
  return conclude(arguments, record, earlier);
}

constexpr const char* bench_examples =
    R"(Columns: seeds; cells per second for measures alone and for measures with adjacency, from seeds in
host memory to results in host memory, the best of --repeat runs; arithmetic and bandwidth: the work
counted for these cells, as a share of the rates that the device reaches in two small kernels (shown
above the table). The work is a model (clipping by the seeds near enough to cut, and integration, with
each number moved once), not a count of executed operations: the time also includes searching and
transfers between host and device. See docs/performance.md. Then seconds to build the kernels (little if
they were cached: see --cold), and from opening the device to the measures of the first 1,000 cells.
Every run is checked: measures that do not sum to the domain's are a failure.
Examples:
  powercell bench                                      every device and precision, in under two minutes
  powercell bench --device gpu --json gpu.json
  powercell bench --quick --domain cube --domain part.mesh --precision float
  powercell bench --json new.json --compare old.json --fail-below 0.9)";

void add_options(CLI::App& command, BenchArguments& arguments) {
  const auto repeated = [&](const char* name, std::vector<std::string>& to, const char* help) {
    command.add_option(name, to, help)->expected(1)->take_all();
  };
  repeated("--device", arguments.devices,
           "Part of a device's name, its number P:D, cpu or gpu; may be repeated. Default: POWERCELL_DEVICE, "
           "else every device");
  repeated("--domain", arguments.domains,
           "square, cube, surface (5,120 triangles), volume (13,824 tetrahedra), or a domain as for 'diagram "
           "--domain'; may be repeated. Default: the first four");
  command
      .add_option("--precision", arguments.precision, "double, float, or auto: each that the device supports")
      ->check(CLI::IsMember({"auto", "double", "float"}));
  command
      .add_option("--n", arguments.n,
                  "Seeds. Default: those of --compare, else as many as a run of one second takes")
      ->check(CLI::Range(std::size_t{1}, most_seeds_of_diagram));
  command.add_option("--repeat", arguments.repeat, "Runs of each kind; the best counts")
      ->check(above_zero())
      ->capture_default_str();
  command.add_flag("--quick", arguments.quick, "Few seeds, in about ten seconds: rates are lower and vary");
  command.add_flag(
      "--cold", arguments.cold,
      "Compile the kernels of each row anew, to time it: the caches of powercell, PoCL and NVIDIA's driver "
      "are not used");
  command
      .add_option("--json", arguments.json_file, "Write all figures as JSON; - for stdout without a table")
      ->type_name("FILE");
  CLI::Option* compare =
      command.add_option("--compare", arguments.compare_file, "Print ratios to an earlier --json FILE")
          ->type_name("FILE");
  command
      .add_option("--fail-below", arguments.fail_below,
                  "With --compare: exit with 1 if a rate is below this share of the earlier one")
      ->type_name("RATIO")
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
  return [arguments] { return run(*arguments); };
}

}  // namespace powercell::app
