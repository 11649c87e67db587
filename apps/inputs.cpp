#include "apps/inputs.hpp"

#include <CLI/CLI.hpp>
#include <powercell/error.hpp>

#include "apps/io/names.hpp"
#include "apps/seeds_outside.hpp"

namespace powercell::app {
namespace {

/// The fault of an argument of --seeds, as far as it shows without reading a file; empty if it has none.
std::string wrong_seeds(const std::string& spec) {
  try {
    if (io::is_random_spec(spec)) io::parse_random_spec(spec);
    return {};
  } catch (const Error& error) {
    return error.what();
  }
}

void add_columns(CLI::App& command, InputArguments& arguments) {
  io::ColumnChoice& columns = arguments.columns;
  const auto add = [&](const char* option, std::string& column, const char* help) {
    command.add_option(option, column, help)->type_name("COLUMN")->group("The table of seeds");
  };
  add("--x-column", columns.position[0],
      "Column of the x coordinates, by its name in the header or its number from 1. Default: x, lon, easting "
      "and the like, else the first");
  add("--y-column", columns.position[1], "Likewise of y");
  add("--z-column", columns.position[2], "Likewise of z");
  add("--weight-column", columns.weight, "Likewise of the weights, lengths squared. Default: weight or w");
  add("--radius-column", columns.radius, "Likewise of radii, whose squares are the weights");
  command
      .add_flag("--allow-outside", arguments.allow_outside,
                "Go on if fewer than one seed in twenty lies in the domain's box")
      ->group("The table of seeds");
}

}  // namespace

void add_inputs(CLI::App& command, InputArguments& arguments, bool required) {
  command
      .add_option(
          "--domain", arguments.domain,
          "A file (.geojson .json .wkt .svg; .off .obj .ply .stl; .mesh .msh .vtu .vtk .tet; .txt), or "
          "square, cube, disk, ball, sphere, torus (with :N for resolution)")
      ->required(required);
  command
      .add_option(
          "--seeds", arguments.seeds,
          "Text or CSV with rows 'x y [z] w', or with columns in any order under a header of these names (or "
          "lon, lat, weight); an .npy file; or random:N[:LO:HI[:SEED]] with weights from LO to HI")
      ->check(wrong_seeds)
      ->required(required);
  command
      .add_option("--kind", arguments.kind,
                  "polygon, surface or volume, for files that can be read as more than one")
      ->check(CLI::IsMember({"polygon", "surface", "volume"}));
  add_columns(command, arguments);
}

Inputs read_inputs(const InputArguments& arguments) {
  io::LoadedDomain domain = io::read_domain(arguments.domain, io::domain_kind(arguments.kind));
  io::SeedTable seeds = io::read_seeds(arguments.seeds, domain.domain, arguments.columns);
  Inputs inputs{std::move(domain), std::move(seeds), 0, {}};
  inputs.outside = count_outside(inputs.domain.domain, inputs.seeds);
  if (!arguments.allow_outside)
    require_inside(inputs.domain.domain, inputs.seeds, inputs.outside, arguments.seeds);
  inputs.notes.push_back(inputs.domain.description);
  if (!inputs.seeds.columns.note.empty()) inputs.notes.push_back(inputs.seeds.columns.note);
  if (inputs.outside > 0) inputs.notes.push_back(outside_line(inputs.outside, inputs.seeds.count()));
  return inputs;
}

}  // namespace powercell::app
