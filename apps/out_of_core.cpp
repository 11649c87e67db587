#include "apps/out_of_core.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <powercell/error.hpp>
#include <powercell/out_of_core.hpp>
#include <span>
#include <vector>

#include "apps/cell_files.hpp"
#include "apps/interrupt.hpp"
#include "apps/io/atomic_file.hpp"
#include "apps/io/tables/seed_stream.hpp"
#include "apps/io/tables/seeds_outside.hpp"
#include "apps/outputs.hpp"
#include "apps/progress.hpp"
#include "apps/report.hpp"
#include "apps/seeds_outside.hpp"

namespace powercell::app {
namespace {

/// Counts the seeds outside the domain's box when they are read for the first time.
class OutsideCount {
 public:
  OutsideCount(const Domain& domain, std::uint64_t seeds, bool allowed)
      : box_(io::seed_box(domain)), seeds_(seeds), allowed_(allowed) {}

  /// \throw Error invalid_seed if hardly any seed is in the box
  void add(std::uint64_t first, std::span<const double> positions) {
    if (first != next_) return;  // read again
    outside_ += io::count_outside(box_, positions);
    next_ += positions.size() / box_.dimension;
    if (next_ == seeds_ && !allowed_) require_inside(outside_, seeds_);
  }
  /// Reads the seeds that were not read, because this run goes on with what an earlier one has sorted.
  std::uint64_t outside(io::SeedStream& seeds) {
    std::vector<double> positions, weights;
    for (; next_ < seeds_; next_ += weights.size()) {
      weights.resize(std::min<std::uint64_t>(seeds_at_once, seeds_ - next_));
      positions.resize(weights.size() * box_.dimension);
      seeds.read(next_, positions, weights);
      outside_ += io::count_outside(box_, positions);
    }
    return outside_;
  }

 private:
  static constexpr std::size_t seeds_at_once = std::size_t{1} << 16;

  io::SeedBox box_;
  std::uint64_t seeds_, outside_ = 0, next_ = 0;
  bool allowed_;
};

void check(const OutOfCoreArguments& arguments) {
  if (arguments.table.empty() && arguments.walls.empty())
    throw WrongUsage("--memory needs --table or --walls, or nothing would be written");
  if (!arguments.inputs.scale_weights.empty())
    throw WrongUsage("--scale-weights does not go with --memory; multiply the weights in the file");
  const std::vector<std::string> files = cell_file_names(arguments.table, arguments.walls, 3);
  for (const std::string& file : files)
    if (io::is_standard_output(file))
      throw WrongUsage("--memory writes to files, which it can go on with; name one instead of '-'");
  check_writable(files, {}, arguments.common.json);
}

/// Where pieces are kept until the files are whole.
std::string parts_folder(const OutOfCoreArguments& arguments) {
  return (arguments.table.empty() ? arguments.walls : arguments.table) + ".parts";
}

nlohmann::json as_json(const OutOfCoreReport& report) {
  return {{"pieces", report.pieces},
          {"kept", report.kept},
          {"again", report.again},
          {"rounds", report.rounds},
          {"fetched", report.fetched},
          {"neighbors", report.neighbors},
          {"clipped", report.clipped},
          {"bytes_read", report.bytes_read},
          {"bytes_written", report.bytes_written},
          {"seconds", {{"sort", report.sort}, {"compute", report.compute}, {"gather", report.gather}}}};
}

std::string pieces_line(const OutOfCoreReport& report) {
  const std::string kept = report.kept > 0 ? fmt::format(" ({} of an earlier run)", report.kept) : "";
  return fmt::format("{} pieces{}; {:.1f} s sorting, {:.1f} s computing, {:.1f} s writing in order",
                     with_commas(report.pieces), kept, report.sort, report.compute, report.gather);
}

void print(const OutOfCoreArguments& arguments, const RunReport& run, const OutOfCoreReport& report) {
  if (arguments.common.json) {
    nlohmann::json json = as_json(run);
    json["out_of_core"] = as_json(report);
    fmt::print("{}\n", json_text(json));
  } else if (!arguments.common.quiet) {
    for (const std::string& note : run.notes) fmt::print("{}\n", note);
    for (const std::string& path : run.files) fmt::print("wrote {}\n", path);
    fmt::print("{}\n{}\n", pieces_line(report), self_check_line(run));
  }
}

}  // namespace

int run_out_of_core(const OutOfCoreArguments& arguments) {
  check(arguments);
  Progress progress({{stage::reading, 1}, {stage::opening, 1}, {"computing", 97}, {stage::writing, 1}},
                    arguments.common.silent());
  RunReport run;
  std::optional<io::SeedStream> opened;
  const auto open_seeds = [&](int dimension) {
    return opened.emplace(arguments.inputs.seeds, dimension, arguments.inputs.columns, "leave --memory out")
        .columns();
  };
  const io::LoadedDomain loaded = read_plane_domain(arguments.inputs, "--memory", open_seeds, run.notes);
  const Domain& domain = loaded.domain;
  print_notes(domain.notes(), arguments.inputs.domain, arguments.common, progress);
  io::SeedStream& seeds = *opened;
  if (!seeds.columns().note.empty()) run.notes.push_back(seeds.columns().note);
  progress.begin(stage::opening);
  const Device device = open_device(arguments.common);
  progress.begin("computing");
  progress.count(static_cast<double>(seeds.count()), "cells");

  OutOfCoreOptions options;
  options.diagram = library_options(arguments.common, progress);
  options.folder = parts_folder(arguments);
  options.memory = arguments.memory;
  options.walls = !arguments.walls.empty();
  OutsideCount outside(domain, seeds.count(), arguments.inputs.allow_outside);
  const SeedSource source{seeds.count(), domain.dimension(), seeds.stamp(),
                          [&](std::uint64_t first, std::span<double> positions, std::span<double> weights) {
                            seeds.read(first, positions, weights);
                            outside.add(first, positions);
                          }};
  run.seeds = run.selected = seeds.count();
  run.precision = precision_name(Precision::float64);
  run.neighbors = neighbors_name(options.diagram.neighbors);
  run.device = device.info().name;
  CellFiles files(arguments.table, arguments.walls, seeds, domain, run);
  OutOfCoreReport report;
  try {
    compute([&] {
      report = compute_out_of_core(
          device, domain, source, [&](const CellRows& rows) { files.take(rows); }, options);
    });
  } catch (const Error& error) {
    const bool stopped = error.code() == ErrorCode::interrupted || interrupted();
    if (!stopped || !std::filesystem::exists(options.folder)) throw;
    throw Error(
        ErrorCode::interrupted,
        fmt::format("interrupted; the same command goes on with what is finished, in {}", options.folder));
  }
  if (seeds.count() == 0) files.take_none(domain.measure());
  run.cells = report.cells;
  run.hidden = report.hidden;
  run.duplicate = report.duplicate;
  run.outside = outside.outside(seeds);
  run.timings.total = report.sort + report.compute + report.gather;
  run.files = cell_file_names(arguments.table, arguments.walls, shift_axes(domain));
  progress.finish();
  describe_times(progress, run);
  print(arguments, run, report);
  return 0;
}

}  // namespace powercell::app
