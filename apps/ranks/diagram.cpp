#include "apps/ranks/diagram.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <powercell/local_diagram.hpp>
#include <powercell/redistributed_seeds.hpp>
#include <thread>

#include "apps/cell_files.hpp"
#include "apps/inputs.hpp"
#include "apps/interrupt.hpp"
#include "apps/io/atomic_file.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/tables/seed_stream.hpp"
#include "apps/io/write/pvtu.hpp"
#include "apps/outputs.hpp"
#include "apps/progress.hpp"
#include "apps/ranks/rows.hpp"
#include "apps/report.hpp"
#include "apps/seeds_outside.hpp"

namespace powercell::app {
namespace {

struct RanksArguments : CommonOptions, InputArguments {
  std::string table, walls;
  std::vector<std::string> outputs;
};

/// The inputs, and the rows of the seeds' file that this rank has.
struct Share {
  std::optional<io::SeedStream> stream;
  std::optional<Domain> domain;
  std::vector<std::uint64_t> ids;  // rows
  std::vector<double> positions, weights;
  std::uint64_t outside = 0;

  SeedsView seeds() const { return {domain->dimension(), positions, weights}; }
};

void check(const RanksArguments& arguments) {
  if (arguments.table.empty() && arguments.walls.empty() && arguments.outputs.empty())
    throw WrongUsage("name --table, --walls or -o, or nothing would be written");
  if (!arguments.scale_weights.empty())
    throw WrongUsage("--scale-weights is of powercell alone; multiply the weights in the file");
  std::vector<std::string> files = cell_file_names(arguments.table, arguments.walls, 3);
  files.insert(files.end(), arguments.outputs.begin(), arguments.outputs.end());
  for (const std::string& file : files)
    if (io::is_standard_output(file)) throw WrongUsage("the ranks write to files; name one instead of '-'");
  check_writable(files, {}, arguments.json);
}

void read_share(const RanksArguments& arguments, const Ranks& ranks, Share& share, RunReport& run,
                Progress& progress) {
  const auto open_seeds = [&](int dimension) {
    return share.stream.emplace(arguments.seeds, dimension, arguments.columns, "use powercell diagram")
        .columns();
  };
  share.domain = read_plane_domain(arguments, "powercell_mpi", open_seeds, run.notes).domain;
  if (ranks.is_first()) print_notes(share.domain->notes(), arguments.domain, arguments, progress);
  io::SeedStream& stream = *share.stream;
  if (!stream.columns().note.empty()) run.notes.push_back(stream.columns().note);
  const RowRange rows = rows_of_rank(stream.count(), ranks.rank(), ranks.size());
  for (std::uint64_t row = rows.begin; row < rows.end; ++row) share.ids.push_back(row);
  share.weights.resize(share.ids.size());
  share.positions.resize(share.ids.size() * static_cast<std::size_t>(share.domain->dimension()));
  stream.read(rows.begin, share.positions, share.weights);
  share.outside = io::count_outside(io::seed_box(*share.domain), share.positions);
}

/// Unless the user says how many threads, those of a machine are shared out among its ranks.
CommonOptions options_of_rank(const RanksArguments& arguments, const Ranks& ranks) {
  CommonOptions options = arguments;
  const int processors = static_cast<int>(std::thread::hardware_concurrency()),
            here = ranks.on_this_machine();
  if (options.threads == 0 && here > 1) options.threads = std::max(1, processors / here);
  return options;
}

/// What the ranks compute with.
struct Place {
  Ranks& ranks;
  const Device& device;
  const Domain& domain;
  Options options;
};

void write_pieces(const std::vector<std::string>& files, const Place& place, const RedistributedSeeds& seeds,
                  const DistributedCells& cells) {
  if (files.empty()) return;
  LocalDiagram local = local_diagram(place.ranks.communicator(), place.device, place.domain, seeds.ids(),
                                     seeds.seeds(), cells, place.options);
  place.ranks.together([&] {
    const std::vector<double> positions = local.diagram.positions();
    const auto d = static_cast<std::size_t>(place.domain.dimension());
    io::VtuPiece piece{place.ranks.rank(), local.diagram, local.cells, {}, {}, {}};
    for (const std::uint32_t k : local.cells) {
      piece.ids.push_back(local.ids[k]);
      piece.positions.insert(piece.positions.end(), &positions[k * d], &positions[k * d] + d);
    }
    for (std::size_t k = 0; k < cells.measures.status.size(); ++k)
      if (cells.measures.status[k] == SeedStatus::ok) piece.weights.push_back(seeds.seeds().weights[k]);
    for (const std::string& file : files) io::write_vtu_piece(file, piece);
  });
  place.ranks.together([&] {
    if (!place.ranks.is_first()) return;
    for (const std::string& file : files) io::write_pvtu(file, place.ranks.size());
  });
}

nlohmann::json as_json(const ExchangeReport& report) {
  return {{"rounds", report.rounds},   {"fetched", report.fetched},   {"neighbors", report.neighbors},
          {"clipped", report.clipped}, {"outlines", report.outlines}, {"requests", report.requests},
          {"replies", report.replies}, {"ending", report.ending}};
}

void print(const RanksArguments& arguments, const RunReport& run, const ExchangeReport& exchange, int ranks) {
  if (arguments.json) {
    nlohmann::json json = as_json(run);
    json["ranks"] = ranks;
    json["exchange"] = as_json(exchange);
    fmt::print("{}\n", json_text(json));
  } else if (!arguments.quiet) {
    for (const std::string& note : run.notes) fmt::print("{}\n", note);
    for (const std::string& path : run.files) fmt::print("wrote {}\n", path);
    fmt::print("{} ranks, {} rounds, {} seeds sent to other ranks\n{}\n", ranks, exchange.rounds,
               with_commas(exchange.fetched), self_check_line(run));
  }
}

/// Enters what all ranks have together.
void describe(const Ranks& ranks, const Share& share, const Measures& measures, RunReport& run) {
  run.seeds = run.selected = share.stream->count();
  run.cells = ranks.sum(std::uint64_t{measures.count(SeedStatus::ok)});
  run.hidden = ranks.sum(std::uint64_t{measures.count(SeedStatus::hidden)});
  run.duplicate = ranks.sum(std::uint64_t{measures.count(SeedStatus::duplicate)});
  run.measure = ranks.sum(measures.total());
  run.domain_measure = share.domain->measure();
  run.outside = ranks.sum(share.outside);
  if (run.domain_measure > 0)
    run.relative_error = std::abs(run.measure - run.domain_measure) / run.domain_measure;
  require_partition(run);
}

int run(const RanksArguments& arguments, Ranks& ranks) {
  ranks.together([&] {
    if (ranks.is_first()) check(arguments);
  });
  Progress progress({{stage::reading, 5}, {stage::opening, 2}, {"computing", 78}, {stage::writing, 15}},
                    arguments.silent() || !ranks.is_first());
  RunReport run;
  Share share;
  ranks.together([&] { read_share(arguments, ranks, share, run, progress); });
  if (!arguments.allow_outside) require_inside(ranks.sum(share.outside), share.stream->count());
  progress.begin(stage::opening);
  const CommonOptions common = options_of_rank(arguments, ranks);
  std::optional<Device> device;
  ranks.together([&] { device = open_device(common); });
  run.device = device_name(*device);
  run.precision = precision_name(Precision::float64);
  progress.begin("computing");
  progress.count(static_cast<double>(share.ids.size()), "cells");
  const Place place{ranks, *device, *share.domain, library_options(common, progress)};
  run.neighbors = neighbors_name(place.options.neighbors);

  RedistributedSeeds moved(ranks.communicator(), share.ids, share.seeds(), &*share.domain);
  share.ids = {}, share.positions = {}, share.weights = {};
  DistributedCells cells;
  compute([&] {
    cells = compute_distributed(ranks.communicator(), *device, *share.domain, moved.ids(), moved.seeds(),
                                {place.options});
  });
  describe(ranks, share, cells.measures, run);
  progress.begin(stage::writing);
  write_pieces(arguments.outputs, place, moved, cells);
  run.files = cell_file_names(arguments.table, arguments.walls, shift_axes(*share.domain));
  if (!run.files.empty()) {
    const DistributedCells own = moved.send_back(cells);
    RunReport sums;  // the files check theirs
    CellFiles files(arguments.table, arguments.walls, *share.stream, *share.domain, sums);
    write_rows(ranks, own, share.stream->count(), files);
  }
  run.files.insert(run.files.end(), arguments.outputs.begin(), arguments.outputs.end());
  run.timings.total = progress.seconds("computing");
  progress.finish();
  describe_times(progress, run);
  if (ranks.is_first()) print(arguments, run, cells.report, ranks.size());
  return 0;
}

constexpr const char* examples =
    "Examples:\n"
    "  mpirun -n 4 powercell_mpi diagram --domain cube --seeds big.npy --table cells.npy --walls walls.npy\n"
    "  mpirun -n 4 powercell_mpi diagram --domain part.mesh --seeds grains.csv -o grains.pvtu\n"
    "Files are read and written by all ranks, in one file system.";

}  // namespace

Command add_diagram_of_ranks(CLI::App& app, Ranks& ranks) {
  auto arguments = std::make_shared<RanksArguments>();
  CLI::App* command = app.add_subcommand("diagram", "Compute a power diagram on all ranks and write it");
  add_inputs(*command, *arguments, true);
  add_output_files(*command, arguments->outputs, ".pvtu, with a piece for each rank in a folder beside it",
                   [](const std::string& path) {
                     if (io::lower_extension(path) != ".pvtu")
                       throw Error(ErrorCode::invalid_file, path + ": powercell_mpi writes .pvtu files");
                   });
  add_table_file(*command, arguments->table);
  command
      ->add_option(
          "--walls", arguments->walls,
          "CSV with one row for each side of a wall, or compressed sparse rows in three arrays of NumPy")
      ->type_name("FILE.csv|FILE.npy")
      ->default_str("none");
  add_device_option(*command, *arguments);
  add_threads_option(*command, *arguments);
  add_output_options(*command, *arguments);
  command->footer(examples);
  return [arguments, &ranks] { return run(*arguments, ranks); };
}

}  // namespace powercell::app
