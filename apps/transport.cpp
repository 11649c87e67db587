// powercell transport: the weights that give cells prescribed masses, from files to files.
#include "apps/io/write/transport.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/common.hpp"
#include "apps/density_choice.hpp"
#include "apps/inputs.hpp"
#include "apps/interrupt.hpp"
#include "apps/io/tables/read_masses.hpp"
#include "apps/io/write/output.hpp"
#include "apps/io/write/table.hpp"
#include "apps/number_checks.hpp"
#include "apps/option_words.hpp"
#include "apps/outputs.hpp"
#include "apps/picture_choice.hpp"
#include "apps/progress.hpp"
#include "apps/report.hpp"

namespace powercell::app {
namespace {

struct TransportArguments : CommonOptions, InputArguments {
  PictureArguments picture;
  std::string masses, mass_column, linear = "auto", table, walls, log;
  DensityArguments density;
  double tolerance = 0;
  int most_steps = 500;
  bool rescale = false;
  std::vector<std::string> outputs;
};

const std::map<std::string, LinearSolver> solvers = {{"auto", LinearSolver::automatic},
                                                     {"dense", LinearSolver::dense},
                                                     {"direct", LinearSolver::direct},
                                                     {"multilevel", LinearSolver::multilevel}};

constexpr const char* solving = "solving";

TransportOptions solver_options(const TransportArguments& arguments, const Domain& domain,
                                Progress& progress) {
  TransportOptions options;
  options.density = read_density(arguments.density, domain);
  options.tolerance = arguments.tolerance;
  options.max_steps = arguments.most_steps;
  options.linear = solvers.at(arguments.linear);
  options.rescale = arguments.rescale;
  options.diagram = library_options(arguments);
  const double tolerance = arguments.tolerance > 0 ? arguments.tolerance : 1e-6;
  options.progress = [&progress, tolerance, first = 0.0,
                      approach = Approach()](const TransportStep& step) mutable {
    first = std::max(first, step.error);
    progress.note(fmt::format("step {}, masses to {:.0e}", step.step, step.error));
    // Steps with a blended density do not show how much is left.
    const double share = step.spread == 0 ? logarithmic_share(step.error, first, tolerance) : 0;
    return progress.at(approach.step(share));
  };
  return options;
}

struct TransportReport {
  RunReport run;  // of the diagram at the end
  double solve = 0;
};

void write_files(const TransportArguments& arguments, TransportSolver& solver, const Inputs& inputs,
                 const io::PictureStyle& style, RunReport& report) {
  const SeedsView seeds{inputs.seeds.dimension, inputs.seeds.positions, solver.result().weights};
  const auto written = [&report](const std::string& path) { report.files.push_back(path); };
  write_diagram(arguments.outputs, solver.diagram(), seeds,
                {.inputs = inputs.view(), .weights_as_discs = false, .style = style});
  report.files = arguments.outputs;
  if (!arguments.table.empty()) {
    io::write_transport_table(arguments.table, seeds, solver.result(), inputs.view());
    written(arguments.table);
  }
  if (!arguments.walls.empty()) {
    io::write_walls(arguments.walls, solver.diagram().adjacency(), inputs.view(),
                    {.shift_axes = shift_axes(solver.diagram().domain())});
    written(arguments.walls);
  }
  if (!arguments.log.empty()) {
    io::write_steps(arguments.log, solver.result());
    written(arguments.log);
  }
}

nlohmann::json as_json(const TransportReport& report, const TransportResult& result) {
  const RunReport& run = report.run;
  double diagrams = 0, linear = 0;
  for (const TransportStep& step : result.steps) {
    diagrams += step.diagram_seconds;
    linear += step.linear_seconds;
  }
  return {{"seeds", run.seeds},
          {"cells", run.cells},
          {"hidden", run.hidden},
          {"outside", run.outside},
          {"merged", result.merged},
          {"converged", result.converged},
          {"error", result.error},
          {"quadrature_error", result.quadrature_error},
          {"rounding_error", result.rounding_error},
          {"tolerance", result.tolerance},
          {"steps", result.newton_steps()},
          {"diagrams", result.diagrams},
          {"primal", result.primal},
          {"dual", result.dual},
          {"total_mass", result.total_mass},
          {"domain_measure", run.domain_measure},
          {"device", run.device},
          {"precision", run.precision},
          {"neighbors", run.neighbors},
          {"version", version()},
          {"seconds",
           {{"solve", report.solve},
            {"diagrams", diagrams},
            {"linear", linear},
            {"read", run.read},
            {"open", run.open},
            {"build", run.build},
            {"write", run.write},
            {"run", run.run}}},
          {"crs", run.crs},
          {"projection", run.projection},
          {"notes", run.notes},
          {"files", run.files}};
}

std::string counted(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", with_commas(count), what, count == 1 ? "" : "s");
}

std::string result_line(const TransportReport& report, const TransportResult& result) {
  std::string line =
      fmt::format("{} cells, masses met to {:.1e} in {} ({})", with_commas(report.run.cells), result.error,
                  counted(result.newton_steps(), "step"), counted(result.diagrams, "diagram"));
  if (result.merged > 0) line += fmt::format(", {} merged with others", counted(result.merged, "seed"));
  if (result.converged && result.error >= result.tolerance)
    line += fmt::format(", as well as weights in double precision allow ({:.1e})", result.rounding_error);
  if (report.run.hidden > 0) line += fmt::format(", {} hidden", with_commas(report.run.hidden));
  return line + fmt::format(
                    "; W2^2 = {:.12g} (dual {:.12g}); {}, {}, {}; {:.3f} s (and {:.3f} s reading, "
                    "{:.3f} s writing{})",
                    result.primal, result.dual, report.run.device, report.run.precision, report.run.neighbors,
                    report.solve, report.run.read, report.run.write, building_note(report.run.build));
}

[[noreturn]] void refuse_unconverged(const TransportResult& result, const RunReport& report) {
  std::vector<double> target(result.target.size());  // of a cell: that of all seeds merged in it
  for (std::size_t i = 0; i < target.size(); ++i) target[result.merged_with[i]] += result.target[i];
  std::size_t worst = 0;
  double error = -1;
  for (std::size_t i = 0; i < result.mass.size(); ++i) {
    if (result.merged_with[i] != i) continue;
    const double here = std::abs(result.mass[i] / target[i] - 1);
    if (here > error) {
      error = here;
      worst = i;
    }
  }
  const bool integrals = !(result.quadrature_error < result.tolerance);
  std::string why;
  if (!(result.error < result.tolerance))
    why = fmt::format("the masses are met to {:.1e}, not {:.1e} (seed {}: {:.6g} for {:.6g})", result.error,
                      result.tolerance, worst, result.mass[worst], target[worst]);
  if (integrals)
    why += fmt::format("{}{}, not {:.1e}", why.empty() ? "" : "; ",
                       integrals_are_right_to(result.quadrature_error), result.tolerance);
  std::string remedy = "try --max-steps, --tolerance or --precision double";
  if (integrals)
    remedy = remedy_of_integrals;
  else if (result.error < result.rounding_error)
    remedy = fmt::format(
        "weights in double precision allow no better where seeds lie so close: --tolerance {:.1g}",
        2 * result.error);
  throw Error(ErrorCode::not_converged,
              fmt::format("not converged: after {} {}{}; {}", counted(result.newton_steps(), "step"), why,
                          report.files.empty() ? "" : "; the files hold the best weights found", remedy));
}

int run(const TransportArguments& arguments) {
  check_writable(arguments.outputs, {arguments.table, arguments.walls, arguments.log}, arguments.json);
  Progress progress({{stage::reading, 3}, {stage::opening, 2}, {solving, 85}, {stage::writing, 10}},
                    arguments.silent());
  const Inputs inputs = read_inputs(arguments);
  print_notes(inputs.domain.domain.notes(), arguments.domain, arguments, progress);
  const Domain& domain = inputs.domain.domain;
  const io::SeedTable& table = inputs.seeds;
  for (const std::string& path : arguments.outputs) io::check_output(path, domain, table.count());
  // The weights that will be found are not those of the table.
  const SeedsView positions{table.dimension, table.positions, {}};
  const io::PictureStyle style =
      picture_style(arguments.picture, {arguments.outputs, domain.kind(), inputs.view(), positions});
  std::vector<double> masses;
  if (!arguments.masses.empty())
    masses = io::read_masses(arguments.masses, arguments.mass_column, table.count());
  else if (!arguments.mass_column.empty())
    masses = io::masses_of_table(table, arguments.mass_column, arguments.seeds);
  const TransportOptions options = solver_options(arguments, domain, progress);
  TransportReport report;

  progress.begin(stage::opening);
  const Device device = open_device(arguments);
  progress.begin(solving);
  TransportSolver solver(device, domain, options);
  solver.set_seeds(table.view());
  solver.set_masses(masses);
  compute([&] { solver.solve(); });
  const TransportResult& result = solver.result();
  report.run = report_of(solver.diagram());
  describe_inputs(inputs, report.run);
  require_partition(report.run);
  progress.begin(stage::writing);
  write_files(arguments, solver, inputs, style, report.run);
  progress.finish();
  report.solve = progress.seconds(solving);
  describe_times(progress, report.run);

  if (arguments.json) {
    fmt::print("{}\n", json_text(as_json(report, result)));
  } else if (!arguments.quiet) {
    for (const std::string& note : inputs.notes) fmt::print("{}\n", note);
    for (const std::string& path : report.run.files) fmt::print("wrote {}\n", path);
    fmt::print("{}\n", result_line(report, result));
  }
  if (!result.converged) {
    std::fflush(stdout);
    refuse_unconverged(result, report.run);
  }
  return 0;
}

constexpr const char* transport_examples =
    "Examples:\n"
    "  powercell transport --domain square --seeds random:1000 -o equal.svg\n"
    "  powercell transport --domain italy.geojson --seeds towns.csv --mass-column people --rescale "
    "-o map.png\n"
    "  powercell transport --domain part.mesh --seeds grains.txt --masses sizes.csv --table weights.csv\n"
    "  powercell transport --domain square --seeds s.csv --density 'exp(-8*((x-.5)^2+(y-.5)^2))' --log "
    "steps.jsonl\n"
    "  powercell transport --domain square --seeds random:500 --image photo.png -o cells.svg\n"
    "The table contains weights and can be used as --seeds, here and in 'powercell diagram'.";

void add_solver_options(CLI::App& command, TransportArguments& arguments) {
  command
      .add_option("--masses", arguments.masses,
                  "Table with one mass for each seed, in their order: one column, or one named 'mass'")
      ->type_name("FILE.csv")
      ->default_str("equal masses");
  command
      .add_option("--mass-column", arguments.mass_column,
                  "Name of that column; without --masses, of a column of the seeds' table")
      ->type_name("COLUMN")
      ->default_str("mass, of the table of --masses");
  command.add_flag("--rescale", arguments.rescale,
                   "Masses are ratios: scale them to sum to the domain's mass");
  add_density_options(command, arguments.density);
  command.add_option("--tolerance", arguments.tolerance, "Largest relative error of a mass")
      ->check(between(1e-16, 0.999))
      ->default_str("1e-6, in single precision 1e-3");
  command.add_option("--max-steps", arguments.most_steps, "Largest number of steps")
      ->check(not_below_zero())
      ->capture_default_str();
  command.add_option("--linear", arguments.linear, "Linear solver")
      ->check(one_of({"auto", "dense", "direct", "multilevel"}))
      ->capture_default_str();
}

}  // namespace

Command add_transport(CLI::App& app) {
  auto arguments = std::make_shared<TransportArguments>();
  CLI::App* command = app.add_subcommand("transport", "Find the weights that give cells prescribed masses");
  add_inputs(*command, *arguments, true);
  add_solver_options(*command, *arguments);
  add_output_files(*command, arguments->outputs, std::string(io::known_outputs()), io::check_output_format);
  add_picture_options(*command, arguments->picture, "-o");
  command
      ->add_option("--table", arguments->table, "CSV with one row for each seed: weight, mass, centroid, ...")
      ->type_name("FILE.csv")
      ->default_str("none");
  command
      ->add_option("--walls", arguments->walls,
                   "CSV with one row for each side of a wall: seed,neighbor,measure, and in a periodic "
                   "domain sx,sy[,sz]: "
                   "the periods by which the neighbour is moved")
      ->type_name("FILE.csv")
      ->default_str("none");
  command->add_option("--log", arguments->log, "JSON Lines: one object for each step of the solver")
      ->type_name("FILE.jsonl")
      ->default_str("none");
  add_common_options(*command, *arguments);
  command->footer(transport_examples);
  return [arguments] { return run(*arguments); };
}

}  // namespace powercell::app
