// powercell diagram: a diagram, from files to files.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/common.hpp"
#include "apps/inputs.hpp"
#include "apps/interrupt.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/write/cell_writers.hpp"
#include "apps/io/write/npy.hpp"
#include "apps/io/write/output.hpp"
#include "apps/io/write/table.hpp"
#include "apps/only.hpp"
#include "apps/out_of_core.hpp"
#include "apps/outputs.hpp"
#include "apps/picture_choice.hpp"
#include "apps/progress.hpp"
#include "apps/report.hpp"

namespace powercell::app {
namespace {

struct DiagramArguments : CommonOptions, InputArguments {
  PictureArguments picture;
  std::string table, walls, only;
  std::uint64_t memory = 0;  // 0: all in memory
  bool facets = false, whole_cells = false;
  int repeat = 1;
  std::vector<std::string> outputs;
};

void write_files(const DiagramArguments& arguments, Diagram& diagram, const Inputs& inputs,
                 const io::PictureStyle& style, std::span<const std::uint32_t> only, RunReport& report) {
  const SeedsView seeds = inputs.seeds.view();
  write_diagram(arguments.outputs, diagram, seeds,
                {.inputs = inputs.view(), .whole_cells = arguments.whole_cells, .style = style});
  report.files = arguments.outputs;
  if (io::is_npy(arguments.table)) {
    const auto table = io::table_writer(arguments.table, seeds.dimension, seeds.size());
    table->add({0, seeds, diagram.measures(), diagram.adjacency().offset, {}, {}, {}});
    table->commit();
    report.files.push_back(arguments.table);
  } else if (!arguments.table.empty()) {
    io::write_table(arguments.table, seeds, diagram.measures(), diagram.adjacency(), inputs.view(), only);
    report.files.push_back(arguments.table);
  }
  if (!arguments.walls.empty()) {
    io::write_walls(arguments.walls, diagram.adjacency(), inputs.view(),
                    {.shift_axes = shift_axes(diagram.domain()),
                     .facets = arguments.facets ? &diagram.boundary_walls() : nullptr,
                     .only = only});
    report.files.push_back(arguments.walls);
  }
}

void print(const DiagramArguments& arguments, const Inputs& inputs, const RunReport& report) {
  if (arguments.json) {
    fmt::print("{}\n", json_text(as_json(report)));
  } else if (!arguments.quiet) {
    for (const std::string& note : inputs.notes) fmt::print("{}\n", note);
    for (const std::string& path : report.files) fmt::print("wrote {}\n", path);
    fmt::print("{}\n", self_check_line(report));
  }
}

/// \throw WrongUsage for options that do not go together
void check_together(const DiagramArguments& arguments) {
  if (!arguments.only.empty() && !arguments.outputs.empty())
    throw WrongUsage("--only is for --table and --walls; -o draws and writes all cells");
  if (!arguments.only.empty() && arguments.table.empty() && arguments.walls.empty())
    throw WrongUsage("--only needs --table or --walls, or nothing would be written");
  if (!arguments.only.empty() && arguments.certify)
    throw WrongUsage("--certify checks laws of all cells; leave it or --only out");
  if (!arguments.only.empty() && io::is_npy(arguments.table))
    throw WrongUsage("an array in .npy has a row for each seed; with --only write the table as .csv");
  if (arguments.memory == 0 && io::is_npy(arguments.walls))
    throw WrongUsage("walls are written as .npy with --memory alone; write them as .csv");
  if (arguments.facets && arguments.walls.empty())
    throw WrongUsage("--facets adds rows to --walls; name that file");
  const auto is_vtu = [](const std::string& path) { return io::lower_extension(path) == ".vtu"; };
  if (arguments.whole_cells && std::none_of(arguments.outputs.begin(), arguments.outputs.end(), is_vtu))
    throw WrongUsage("--whole-cells is for .vtu files; name one with -o");
}

/// Computes everything that the files need in one pass, as often as --repeat says. Returns the seconds of
/// each time.
std::vector<double> compute_repeatedly(const DiagramArguments& arguments, Diagram& diagram,
                                       const SeedsView& seeds, std::span<const std::uint32_t> only,
                                       Progress& progress) {
  const bool geometry = !arguments.outputs.empty(),
             walls = geometry || !arguments.table.empty() || !arguments.walls.empty();
  std::vector<double> seconds;
  progress.count(static_cast<double>(seeds.size()) * arguments.repeat, "cells");
  for (int k = 0; k < arguments.repeat; ++k) {
    progress.part(static_cast<double>(k) / arguments.repeat, (k + 1.0) / arguments.repeat);
    diagram.set_seeds(seeds);
    if (!arguments.only.empty()) diagram.select(only);
    compute([&] { diagram.compute(walls, geometry); });
    seconds.push_back(diagram.timings().total);
  }
  return seconds;
}

/// \throw WrongUsage for options that need all cells in memory
int run_by_pieces(const DiagramArguments& arguments) {
  if (!arguments.outputs.empty() || !arguments.only.empty() || arguments.facets || arguments.repeat > 1)
    throw WrongUsage(
        "--memory is for --table and --walls of all seeds; leave -o, --only, --facets and --repeat out, or "
        "--memory");
  return run_out_of_core({arguments, arguments, arguments.table, arguments.walls, arguments.memory});
}

int run(const DiagramArguments& arguments) {
  check_together(arguments);
  if (arguments.memory > 0) return run_by_pieces(arguments);
  check_writable(arguments.outputs, {arguments.table, arguments.walls}, arguments.json);
  Progress progress({{stage::reading, 5}, {stage::opening, 2}, {"computing", 78}, {stage::writing, 15}},
                    arguments.silent());
  Inputs inputs = read_inputs(arguments);
  print_notes(inputs.domain.domain.notes(), arguments.domain, arguments, progress);
  const Domain& domain = inputs.domain.domain;
  for (const std::string& path : arguments.outputs) io::check_output(path, domain, inputs.seeds.count());
  if (arguments.whole_cells && domain.kind() != DomainKind::volume)
    throw WrongUsage("--whole-cells is for volumes: a polygon of VTK has no holes, and lies in one plane");
  const SeedsView seeds = inputs.seeds.view();
  const io::PictureStyle style =
      picture_style(arguments.picture, {arguments.outputs, domain.kind(), inputs.view(), seeds});

  progress.begin(stage::opening);
  const Device device = open_device(arguments);
  progress.begin("computing");
  Diagram diagram(device, domain, library_options(arguments, progress));
  const std::vector<std::uint32_t> only =
      arguments.only.empty() ? std::vector<std::uint32_t>() : read_only(arguments.only, inputs.seeds);
  const std::vector<double> seconds = compute_repeatedly(arguments, diagram, seeds, only, progress);
  RunReport report = report_of(diagram);
  report.repeats = seconds;
  note_hidden(inputs, report);
  describe_inputs(inputs, report);
  if (arguments.only.empty()) require_partition(report);
  progress.begin(stage::writing);
  write_files(arguments, diagram, inputs, style, only, report);
  progress.finish();
  describe_times(progress, report);
  print(arguments, inputs, report);
  return 0;
}

constexpr const char* diagram_examples =
    "Examples:\n"
    "  powercell diagram --domain square --seeds random:2000 -o cells.svg\n"
    "  powercell diagram --domain italy.geojson --seeds towns.csv -o map.png --table areas.csv\n"
    "  powercell diagram --domain part.mesh --seeds random:5000:0:4:7 -o grains.vtu --json\n"
    "  powercell diagram --domain part.mesh --seeds grains.csv --color-by phase --camera iso -o part.png\n"
    "  powercell diagram --domain cube --seeds packing.csv --only probes.txt --table few.csv\n"
    "  powercell diagram --domain mesh.off --seeds s.npy --precision float --device gpu --walls walls.csv\n"
    "A weight is a length squared: for a disc or ball of radius r it is r * r.";

}  // namespace

Command add_diagram(CLI::App& app) {
  auto arguments = std::make_shared<DiagramArguments>();
  CLI::App* command = app.add_subcommand("diagram", "Compute a power diagram and write it");
  add_inputs(*command, *arguments, true);
  add_output_files(*command, arguments->outputs, std::string(io::known_outputs()), io::check_output_format);
  add_picture_options(*command, arguments->picture, "-o");
  add_table_file(*command, arguments->table);
  command
      ->add_option("--walls", arguments->walls,
                   "CSV with one row for each side of a wall: seed,neighbor,measure, and in a periodic "
                   "domain sx,sy[,sz]: "
                   "the periods by which the neighbour is moved")
      ->type_name("FILE.csv")
      ->default_str("none");
  command->add_flag(
      "--facets", arguments->facets,
      "In --walls, also the facets of the domain that cells have: rows with a facet instead of a "
      "neighbor");
  command->add_flag(
      "--whole-cells", arguments->whole_cells,
      "In .vtu of a volume, one polyhedron for each cell in place of one for each convex piece of "
      "it, of which it has one in each element of the mesh that it meets");
  command
      ->add_option(
          "--only", arguments->only,
          "Compute the cells of some seeds only, for --table and --walls: a file with an index from 0, "
          "or an id (--id-column), in each line")
      ->type_name("FILE")
      ->default_str("all cells");
  command
      ->add_option(
          "--memory", arguments->memory,
          "Compute piece after piece in files, within so much memory, as in 4G: for --table and --walls "
          "of seeds in an .npy, text or CSV of any size. What is finished is kept in a folder beside the "
          "file, and the same command goes on with it. With .npy instead of .csv, walls are compressed "
          "sparse rows in three arrays")
      ->transform(CLI::AsSizeValue(false).description(""))
      ->type_name("SIZE")
      ->default_str("all in memory");
  command
      ->add_option(
          "--repeat", arguments->repeat,
          "Compute the diagram that often and report the time of each: the first one allocates memory, later "
          "ones are those of a loop")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  add_common_options(*command, *arguments);
  command->footer(diagram_examples);
  return [arguments] { return run(*arguments); };
}

}  // namespace powercell::app
