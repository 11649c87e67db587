// powercell sample: blue noise, quantisers and stippling.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/common.hpp"
#include "apps/inputs.hpp"
#include "apps/interrupt.hpp"
#include "apps/io/atomic_file.hpp"
#include "apps/io/picture/picture.hpp"
#include "apps/io/read/domain.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/write/output.hpp"
#include "apps/io/write/points.hpp"
#include "apps/number_checks.hpp"
#include "apps/option_words.hpp"
#include "apps/outputs.hpp"
#include "apps/picture_choice.hpp"
#include "apps/progress.hpp"
#include "apps/report.hpp"
#include "apps/sampling/notes.hpp"
#include "apps/sampling/study.hpp"

namespace powercell::app {
namespace {

struct SampleArguments : CommonOptions {
  SourceArguments source;
  std::size_t count = 1000;
  std::string mode = "blue", descent = "auto", analysis;
  int iterations = 0, runs = 1;
  double movement = 1e-4, hexatic = 0.61, tolerance = 1e-6;
  std::uint64_t random_seed = 1;
  std::vector<std::string> outputs, cells;
  PictureArguments picture;
};

SamplingOptions sampling_options(const SampleArguments& arguments, const Source& source) {
  SamplingOptions options;
  options.density = source.density;
  options.mode = arguments.mode == "blue" ? SamplingMode::blue : SamplingMode::quantise;
  if (arguments.descent == "lloyd") options.descent = SamplingDescent::lloyd;
  if (arguments.descent == "lbfgs") options.descent = SamplingDescent::lbfgs;
  options.iterations = arguments.iterations;
  options.hexatic = arguments.hexatic;
  options.movement = arguments.movement;
  options.capacity_tolerance = arguments.tolerance;
  options.random_seed = arguments.random_seed;
  options.diagram = library_options(arguments);
  if (arguments.source.paper != 0) {
    options.mode = SamplingMode::quantise;
    if (options.descent == SamplingDescent::automatic) options.descent = SamplingDescent::lloyd;
    options.movement = 0;
    if (options.iterations == 0) options.iterations = 100;
  }
  return options;
}

/// \throw WrongUsage as picture_style
io::PictureStyle style_of(const SampleArguments& arguments, const Domain& domain) {
  if (!arguments.picture.color_by.empty() && std::ranges::none_of(arguments.cells, io::is_coloured))
    throw WrongUsage("--color-by colours cells; name a picture of them, such as --cells cells.svg");
  const auto shows_dots = [](const std::string& path) {
    return io::is_picture(path) || io::lower_extension(path) == ".csv";
  };
  if (arguments.source.color && std::none_of(arguments.outputs.begin(), arguments.outputs.end(), shows_dots))
    throw WrongUsage(
        "--color is for pictures and tables of points; name one, such as -o dots.svg or -o dots.csv");
  std::vector<std::string> files = arguments.cells;
  files.insert(files.end(), arguments.outputs.begin(), arguments.outputs.end());
  const SeedsView none{domain.dimension(), {}, {}};
  return picture_style(arguments.picture, {files, domain.kind(), {}, none});
}

void write_cells(const SampleArguments& arguments, const Device& device, const Source& source,
                 const io::PictureStyle& style, const SamplingResult& points) {
  if (arguments.cells.empty()) return;
  Diagram diagram(device, source.domain, library_options(arguments));
  const SeedsView seeds{source.domain.dimension(), points.positions, points.weights};
  diagram.set_seeds(seeds);
  diagram.compute(true, true);
  write_diagram(arguments.cells, diagram, seeds, {.weights_as_discs = false, .style = style});
}

std::vector<std::string> write_files(const SampleArguments& arguments, const Device& device,
                                     const Source& source, const io::PictureStyle& style,
                                     const Study& study) {
  std::vector<std::string> written;
  const SamplingResult& points = study.runs.front().points;
  std::vector<double> radii;
  if (source.domain.dimension() == 2 && !arguments.outputs.empty()) radii = dot_radii(device, source, points);
  std::vector<io::Colour> colours;
  if (arguments.source.color) colours = dot_colours(device, source, points);
  for (const std::string& path : arguments.outputs) {
    io::write_points(path, {source.domain, points.positions, points.weights, points.mass, radii, style.size,
                            colours, arguments.source.color && arguments.source.bright});
    written.push_back(path);
  }
  write_cells(arguments, device, source, style, points);
  written.insert(written.end(), arguments.cells.begin(), arguments.cells.end());
  if (!arguments.analysis.empty()) {
    io::AtomicFile file(arguments.analysis);
    file.write(as_json(study, true).dump() + "\n");
    file.commit();
    written.push_back(arguments.analysis);
  }
  return written;
}

void print(const SampleArguments& arguments, const Source& source, const Study& study,
           const std::vector<std::string>& written, const std::vector<std::string>& notes,
           const Progress& progress) {
  if (arguments.json) {
    nlohmann::json json = as_json(study, false);
    json["points"] = study.runs.front().points.weights.size();
    json["files"] = written;
    json["notes"] = source.domain.notes();
    for (const std::string& note : notes) json["notes"].push_back(note);
    json["seconds"] = {
        {"read", progress.seconds(stage::reading)},   {"open", progress.seconds(stage::opening)},
        {"sample", progress.seconds(sampling_stage)}, {"build", progress.build()},
        {"write", progress.seconds(stage::writing)},  {"run", progress.run()}};
    fmt::print("{}\n", json_text(json));
  } else if (!arguments.quiet) {
    fmt::print("{}\n", source.description);
    for (const std::string& path : written) fmt::print("wrote {}\n", path);
    for (const Run& run : study.runs) fmt::print("{}\n", line_of(run));
    if (study.runs.size() > 1 || study.spectrum) fmt::print("{}\n", summary_of(study));
    fmt::print("{:.2f} s in all{}\n", progress.run(), building_note(progress.build()));
  }
}

/// For a run that did not converge: the goal that was missed, and advice.
std::string shortfall(const SamplingResult& points, const SamplingOptions& options, const Domain& domain) {
  constexpr const char* more = "; allow more with --iterations";
  const SamplingStep& last = points.steps.back();
  if (!(points.capacity_error < options.capacity_tolerance))
    return fmt::format("the masses are equal to {:.1e}, not {:.1e}{}", points.capacity_error,
                       options.capacity_tolerance, more);
  if (!(points.quadrature_error < options.capacity_tolerance))
    return fmt::format("{}, not {:.1e}; {}", integrals_are_right_to(points.quadrature_error),
                       options.capacity_tolerance, remedy_of_integrals);
  if (std::isfinite(last.hexatic))
    return fmt::format("the hexatic order is {:.3f}, not {:.3f}{}", last.hexatic, options.hexatic, more);
  const double spacing =
      std::pow(domain.measure() / static_cast<double>(points.weights.size()), 1.0 / domain.cell_dimension());
  return fmt::format(
      "the points still move by {:.1e} of their spacing on average, not {:.1e}{}{}, or accept "
      "the points after these moves with --movement 0",
      last.gradient / spacing, options.movement, more,
      options.descent == SamplingDescent::lloyd ? ", use --descent lbfgs, which needs fewer" : "");
}

/// Whether the waves of a spectrum fit the domain: it is a box of the plane, periodic along both axes.
bool has_spectrum(const Domain& domain) {
  const auto periods = domain.periods();
  return domain.dimension() == 2 && periods[0][0] != 0 && periods[0][1] == 0 && periods[1][0] == 0 &&
         periods[1][1] != 0;
}

/// Spectra take time that grows with the square of the number of points: they are computed for few points or
/// on request.
bool wants_spectra(const SampleArguments& arguments, const Domain& domain) {
  constexpr std::size_t quick = 4096;
  return has_spectrum(domain) && (arguments.count <= quick || !arguments.analysis.empty());
}

/// Of the domain, for notes.
std::string name_of(const SampleArguments& arguments) {
  const SourceArguments& source = arguments.source;
  return !source.domain.empty() ? source.domain : !source.image.empty() ? source.image : "the domain";
}

int run(const SampleArguments& arguments) {
  std::vector<std::string> files = arguments.outputs;
  files.insert(files.end(), arguments.cells.begin(), arguments.cells.end());
  check_writable(std::move(files), {arguments.analysis}, arguments.json);
  Progress progress({{stage::reading, 2}, {stage::opening, 2}, {sampling_stage, 90}, {stage::writing, 6}},
                    arguments.silent());
  const Source source = read_source(arguments.source);
  print_notes(source.domain.notes(), arguments.source.domain, arguments, progress);
  for (const std::string& path : arguments.outputs) io::check_points(path, source.domain);
  for (const std::string& path : arguments.cells) io::check_output(path, source.domain, arguments.count);
  const io::PictureStyle style = style_of(arguments, source.domain);
  progress.begin(stage::opening);
  const Device device = open_device(arguments);
  progress.begin(sampling_stage);
  const SamplingOptions options = sampling_options(arguments, source);
  const Study study = run_study(device, source, arguments.count, options, arguments.runs,
                                wants_spectra(arguments, source.domain), progress);
  progress.begin(stage::writing);
  const std::vector<std::string> written = write_files(arguments, device, source, style, study);
  progress.finish();
  const std::vector<std::string> notes = notes_of(source.domain, study, options.mode);
  print(arguments, source, study, written, notes, progress);
  print_notes(notes, name_of(arguments), arguments, progress);
  for (const Run& one : study.runs)
    if (!one.points.converged)
      throw Error(
          ErrorCode::not_converged,
          fmt::format("not converged after {} iterations; the best points found are written: {}",
                      one.points.steps.back().iteration, shortfall(one.points, options, source.domain)));
  return 0;
}

constexpr const char* sample_examples =
    "Examples:\n"
    "  powercell sample -n 1024 --periodic -o points.svg --runs 10 --analysis spectra.json\n"
    "  powercell sample -n 8000 --image photo.png -o stipples.svg -o stipples.png\n"
    "  powercell sample -n 8000 --image photo.jpg --color -o dots.svg -o dots.csv\n"
    "  powercell sample -n 2000 --domain disk --density 'exp(-4*(x^2+y^2))' -o dots.png --cells cells.svg\n"
    "  powercell sample -n 500 --domain part.mesh --mode quantise --iterations 50 --movement 0 -o "
    "points.csv\n"
    "  powercell sample --paper 2        the 2D experiment of Xiao et al. 2023; --paper 3 for 3D";

void add_source(CLI::App& command, SourceArguments& source) {
  command.add_option("--domain", source.domain, "As in 'powercell diagram'")
      ->type_name("FILE|SHAPE")
      ->check(known_words(io::builtin_domain_names()))
      ->default_str("the unit square, or the box of the image");
  add_domain_options(command, source);
  add_density_options(command, source);
  command
      .add_option("--dot-contrast", source.dot_contrast,
                  "Image: from 0 for equal dots to 0.9 for the largest differences; the ink is the same")
      ->check(between(0, 0.9))
      ->capture_default_str()
      ->needs("--image");
  command
      .add_flag("--color", source.color,
                "Image: dots in its colours, with --bright on black paper; and r, g, b in -o FILE.csv")
      ->needs("--image");
  command
      .add_option("--paper", source.paper,
                  "The experiment of Xiao et al. 2023 in 2 or 3 dimensions: 1,000 points, "
                  "100 iterations, density 1/(|x|^2+0.1)")
      ->check(one_of({"2", "3"}))
      ->default_str("none");
}

}  // namespace

Command add_sample(CLI::App& app) {
  auto arguments = std::make_shared<SampleArguments>();
  CLI::App* command =
      app.add_subcommand("sample", "Blue noise: points whose cells have equal masses of a density");
  command->add_option("-n,--points", arguments->count, "Number of points")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100000000}))
      ->capture_default_str();
  add_source(*command, arguments->source);
  command->add_option("--mode", arguments->mode, "blue: even and irregular; quantise: least energy")
      ->check(one_of({"blue", "quantise"}))
      ->capture_default_str();
  command
      ->add_option("--descent", arguments->descent,
                   "lloyd moves points to the centroids of their cells, lbfgs rests after fewer moves; auto: "
                   "lloyd for blue, lbfgs for quantise")
      ->check(one_of({"auto", "lloyd", "lbfgs"}))
      ->capture_default_str();
  command
      ->add_option("--iterations", arguments->iterations, "Largest number of moves; 0 for the mode's default")
      ->check(not_below_zero())
      ->capture_default_str();
  command->add_option("--hexatic", arguments->hexatic, "blue: hexatic order to stop at, 0.4 to 0.99")
      ->check(between(0.4, 0.99))
      ->capture_default_str();
  command
      ->add_option(
          "--movement", arguments->movement,
          "quantise: stop when points move less than this part of the spacing; 0: after --iterations")
      ->check(not_below_zero())
      ->capture_default_str();
  command->add_option("--tolerance", arguments->tolerance, "Relative tolerance of the masses, 1e-12 to 0.1")
      ->check(between(1e-12, 0.1))
      ->capture_default_str();
  command->add_option("--random", arguments->random_seed, "Random seed of the initial points")
      ->capture_default_str();
  command
      ->add_option("--runs", arguments->runs,
                   "Number of samplings, with consecutive random seeds; figures are averaged")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  add_output_files(*command, arguments->outputs,
                   std::string(io::point_outputs) + ", of the points of the first run",
                   io::check_points_format);
  command
      ->add_option("--cells", arguments->cells, "Cells of the first run, as 'powercell diagram' writes them")
      ->type_name("FILE")
      ->default_str("none")
      ->expected(1)
      ->take_all();
  add_picture_options(*command, arguments->picture, "--cells");
  command
      ->add_option("--analysis", arguments->analysis,
                   "All figures and spectra as JSON; spectra of n points take n^2 time")
      ->type_name("FILE.json")
      ->default_str("none");
  add_common_options(*command, *arguments);
  command->footer(sample_examples);
  return [arguments] { return run(*arguments); };
}

}  // namespace powercell::app
