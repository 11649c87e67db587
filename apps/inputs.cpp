#include "apps/inputs.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <powercell/error.hpp>

#include "apps/common.hpp"
#include "apps/io/names.hpp"
#include "apps/io/printable.hpp"
#include "apps/io/read/domain_box.hpp"
#include "apps/io/read/text.hpp"
#include "apps/option_words.hpp"
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

std::string wrong_scale(const std::string& text) {
  double factor = 0;
  if (text == "auto" || (io::parse_number(text, factor) == io::Parsed::ok && factor > 0)) return {};
  return fmt::format("'{}' is neither a number above 0 nor 'auto'", io::readable(text));
}

/// Area or volume of the domain for each seed, as the square of a length.
double squared_spacing(const Inputs& inputs) {
  const Domain& domain = inputs.domain.domain;
  return std::pow(domain.measure() / static_cast<double>(inputs.seeds.count()),
                  2.0 / domain.cell_dimension());
}

double range(const std::vector<double>& weights) {
  const auto [least, largest] = std::minmax_element(weights.begin(), weights.end());
  return *largest - *least;
}

/// Multiplies the weights as --scale-weights says.
void scale_weights(Inputs& inputs, const std::string& text) {
  std::vector<double>& weights = inputs.seeds.weights;
  if (text.empty() || weights.empty()) return;
  double factor = 1;
  if (text == "auto") {
    if (range(weights) > 0) factor = squared_spacing(inputs) / 4 / range(weights);
  } else {
    io::parse_number(text, factor);
  }
  for (double& weight : weights) weight *= factor;
  inputs.seeds.scaled = true;
  inputs.notes.push_back(fmt::format("weights: multiplied by {}", factor));
}

/// Turnovers taken as weights in m2 would leave a Voronoi diagram without a word.
void note_small_weights(Inputs& inputs) {
  constexpr double hardly = 1e-4;
  const std::vector<double>& weights = inputs.seeds.weights;
  if (weights.size() < 2 || !inputs.seeds.columns.weight || !(range(weights) > 0)) return;
  const double share = range(weights) / squared_spacing(inputs);
  if (share < hardly)
    inputs.notes.push_back(fmt::format(
        "weights: their range is {:.1e} of the squared mean distance of the seeds, so they hardly count "
        "(--scale-weights multiplies them)",
        share));
}

/// Counts the seeds that stand for images inside.
/// \return what a report says of them, and of bounded axes
std::string note_images(Inputs& inputs, const std::string& along_bounded) {
  const Domain& domain = inputs.domain.domain;
  const auto d = static_cast<std::size_t>(domain.dimension());
  const std::vector<double>&given = inputs.seeds.positions, inside = domain.wrapped(given);
  double longest = 0;
  for (std::size_t c = 0; c < d; ++c) longest = std::max(longest, domain.high()[c] - domain.low()[c]);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < given.size(); i += d) {
    double by = 0;
    for (std::size_t c = 0; c < d; ++c) by = std::max(by, std::abs(inside[i + c] - given[i + c]));
    moved += by > 1e-9 * longest;  // less is the rounding of positions inside
  }
  inputs.outside += moved;
  if (moved == 0) return along_bounded;
  const std::string images =
      fmt::format("{} of {} seeds {} outside the periods and {} for {} inside", with_commas(moved),
                  with_commas(inputs.seeds.count()), moved == 1 ? "lies" : "lie",
                  moved == 1 ? "stands" : "stand", moved == 1 ? "an image" : "images");
  return along_bounded.empty() ? images : along_bounded + "; " + images;
}

void add_columns(CLI::App& command, InputArguments& arguments) {
  io::ColumnChoice& columns = arguments.columns;
  const auto add = [&](const char* option, std::string& column, const char* help, const char* otherwise) {
    command.add_option(option, column, help)
        ->type_name("COLUMN")
        ->default_str(otherwise)
        ->group("The table of seeds");
  };
  add("--x-column", columns.position[0],
      "Column of the x coordinates, by its name in the header or its number from 1",
      "x, lon, easting and the like, else the first");
  add("--y-column", columns.position[1], "Likewise of y", "y, lat, northing and the like, else the second");
  add("--z-column", columns.position[2], "Likewise of z", "z, else the third");
  add("--weight-column", columns.weight, "Likewise of the weights, lengths squared",
      "weight or w, else the next");
  add("--radius-column", columns.radius, "Likewise of radii, whose squares are the weights", "none");
  add("--id-column", columns.id, "Likewise of ids, for GeoJSON and --walls; needs a header", "none");
  command
      .add_option(
          "--scale-weights", arguments.scale_weights,
          "Multiply the weights by a number, or 'auto': such that their range is the square of half the mean "
          "distance of the seeds")
      ->check(wrong_scale)
      ->check(known_words({"auto"}))
      ->default_str("1")
      ->type_name("FACTOR")
      ->group("The table of seeds");
  command
      .add_flag("--allow-outside", arguments.allow_outside,
                "Go on if fewer than one seed in twenty lies in the domain's box")
      ->group("The table of seeds");
}

template <class Function>
std::vector<double> map_points(const std::vector<double>& points, const Function& function) {
  std::vector<double> mapped;
  mapped.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); i += 2) {
    const io::MapPoint to = function(io::MapPoint{points[i], points[i + 1]});
    mapped.insert(mapped.end(), to.begin(), to.end());
  }
  return mapped;
}

/// Checks the seeds of a file in the coordinates of the domain's, and moves them to the plane. Returns what a
/// report says of those outside.
std::string move_seeds(Inputs& inputs, const Georeference& place, const io::SeedBox& box,
                       const InputArguments& arguments) {
  io::SeedTable& seeds = inputs.seeds;
  const io::MapPlane* plane = inputs.map.plane.get();
  std::vector<double> moved = seeds.positions;
  if (place.seeds) moved = map_points(moved, [&](auto p) { return place.seeds->forward(p); });
  if (plane) moved = map_points(moved, [&](auto p) { return plane->unwrapped(p); });
  inputs.outside = io::count_outside(box, moved);
  std::string outside = inputs.outside > 0 ? io::outside_line(box, moved, false) : "";
  if (const auto miss = find_miss(box, moved, seeds, place.seeds != nullptr)) {
    if (miss->refused && !arguments.allow_outside)
      throw Error(ErrorCode::invalid_seed,
                  fmt::format("{}: {}; if they are meant to lie there, give --allow-outside", arguments.seeds,
                              miss->message));
    outside = miss->message;
  }
  if (plane) moved = map_points(moved, [&](auto p) { return plane->to_plane(p); });
  if (place.seeds || plane) {
    seeds.given = std::move(seeds.positions);
    seeds.positions = std::move(moved);
  }
  return outside;
}

}  // namespace

void add_inputs(CLI::App& command, InputArguments& arguments, bool required) {
  command
      .add_option(
          "--domain", arguments.domain,
          "A file (.geojson .json .gpkg .wkt .svg; .off .obj .ply .stl; .mesh .msh .vtu .vtk .tet; .txt), or "
          "square, cube, disk, ball, sphere, torus (with :N for resolution), box:LX,LY[,LZ]:HX,HY[,HZ], or "
          "the "
          "periodic lattice:ax,ay/bx,by or lattice:ax,ay,az/bx,by,bz/cx,cy,cz")
      ->type_name("FILE|SHAPE")
      ->check(known_words(io::builtin_domain_names()))
      ->default_str(required ? "" : "none")
      ->required(required);
  command
      .add_option(
          "--seeds", arguments.seeds,
          "Text or CSV with rows 'x y [z] w', or with columns in any order under a header of these names (or "
          "lon, lat, weight), - for those from standard input; points in .geojson or .gpkg "
          "(FILE.gpkg:LAYER), or in a "
          "column of well-known text; an .npy file; or random:N[:LO:HI[:SEED]] with "
          "weights from LO to HI")
      ->type_name("FILE|random:N")
      ->check(wrong_seeds)
      ->check(known_words({"random:"}))
      ->default_str(required ? "" : "none")
      ->required(required);
  add_domain_options(command, arguments);
  add_columns(command, arguments);
  add_map_options(command, arguments);
}

Inputs read_inputs(const InputArguments& arguments) {
  io::DomainArrays arrays = read_domain_arrays(arguments);
  const int dimension = arrays.kind == DomainKind::polygon ? 2 : 3;
  const bool random = io::is_random_spec(arguments.seeds);
  io::SeedTable seeds;
  if (!random) seeds = io::read_seed_file(arguments.seeds, dimension, arguments.columns);
  Georeference place = georeference(arguments, arguments.domain, arrays, seeds.columns);
  const io::MapPlane* plane = place.frame.plane.get();
  const io::SeedBox map_box = io::seed_box(plane ? plane->map_parts() : arrays.parts);
  const std::string description = io::describe(arrays, arguments.domain);
  if (plane) arrays.parts = plane->parts();
  io::LoadedDomain domain = io::load_domain(std::move(arrays), arguments.domain);
  domain.description = description;
  Inputs inputs{std::move(domain), std::move(seeds), std::move(place.frame), 0, {}};
  const Domain& made = inputs.domain.domain;
  std::string outside;
  if (random) {
    inputs.seeds = io::read_seeds(arguments.seeds, made, arguments.columns);
    if (plane)
      inputs.seeds.given = map_points(inputs.seeds.positions, [&](auto p) { return plane->to_map(p); });
  } else {
    const bool on_map = made.kind() == DomainKind::polygon && !made.is_periodic();
    outside = move_seeds(inputs, place, on_map ? map_box : io::seed_box(made), arguments);
  }
  inputs.notes.push_back(inputs.domain.description);
  for (std::string& note : place.notes) inputs.notes.push_back(std::move(note));
  if (!inputs.seeds.columns.note.empty()) inputs.notes.push_back(inputs.seeds.columns.note);
  scale_weights(inputs, arguments.scale_weights);
  note_small_weights(inputs);
  if (made.is_periodic() && !random) outside = note_images(inputs, outside);
  if (!outside.empty()) inputs.notes.push_back(outside);
  return inputs;
}

io::LoadedDomain read_plane_domain(const InputArguments& arguments, const std::string& way,
                                   const std::function<io::SeedColumns(int dimension)>& columns,
                                   std::vector<std::string>& notes) {
  io::DomainArrays arrays = read_domain_arrays(arguments);
  const Georeference place =
      georeference(arguments, arguments.domain, arrays, columns(arrays.kind == DomainKind::polygon ? 2 : 3));
  if (place.frame.plane || place.seeds)
    throw WrongUsage(
        way +
        " computes in the coordinates of the files, but seeds or domain would be projected; save "
        "both in a plane, or give --no-project");
  io::LoadedDomain domain = io::load_domain(std::move(arrays), arguments.domain);
  notes.push_back(domain.description);
  notes.insert(notes.end(), place.notes.begin(), place.notes.end());
  return domain;
}

void note_hidden(Inputs& inputs, const RunReport& report) {
  const std::vector<double>& weights = inputs.seeds.weights;
  if (2 * report.hidden <= report.seeds || weights.empty()) return;
  const double share = range(weights) / squared_spacing(inputs);
  if (!(share > 1)) return;  // seeds outside the domain have no cells either
  inputs.notes.push_back(fmt::format(
      "weights: {} of {} seeds are hidden, as the range of the weights is {:.2g} times the squared mean "
      "distance of the seeds; a weight is a length squared, r * r for a radius r (--scale-weights auto "
      "brings the range to a quarter of that distance squared)",
      with_commas(report.hidden), with_commas(report.seeds), share));
}

void describe_inputs(const Inputs& inputs, RunReport& report) {
  report.outside = inputs.outside;
  report.crs = inputs.map.crs;
  if (inputs.map.plane) report.projection = inputs.map.plane->definition();
  report.notes = inputs.notes;
  const std::vector<std::string> faults = inputs.domain.domain.notes();
  report.notes.insert(report.notes.end(), faults.begin(), faults.end());
}

}  // namespace powercell::app
