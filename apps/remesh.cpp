// powercell remesh: a new mesh of a triangle surface, and its quality.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <powercell/remeshing.hpp>
#include <powercell/repair.hpp>

#include "apps/common.hpp"
#include "apps/interrupt.hpp"
#include "apps/io/atomic_file.hpp"
#include "apps/io/picture/picture.hpp"
#include "apps/io/read/domain.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/write/triangles.hpp"
#include "apps/number_checks.hpp"
#include "apps/option_words.hpp"
#include "apps/outputs.hpp"
#include "apps/picture_choice.hpp"
#include "apps/progress.hpp"
#include "apps/report.hpp"

namespace powercell::app {
namespace {

struct RemeshArguments : CommonOptions {
  std::string input, report;
  std::string method = "fpo";
  std::vector<std::string> outputs;
  CameraArguments picture;
  RemeshOptions remesh;
  bool no_repair = false;
  double weld = -1;
};

/// The new mesh, its quality and that of the old one.
struct Outcome {
  RepairReport repair;
  RemeshResult result;
  MeshQuality before, after;
  double diagonal = 0;
  double input_to_mesh = 0, mesh_to_input = 0;  ///< Hausdorff, one-sided
  double read = 0, repairing = 0, open = 0, remesh = 0, check = 0, write = 0, build = 0, run = 0;
};

double diagonal_of(const Domain& domain) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += std::pow(domain.high()[k] - domain.low()[k], 2);
  return std::sqrt(sum);
}

nlohmann::json as_json(const MeshQuality& q) {
  return {{"vertices", q.vertices},
          {"triangles", q.triangles},
          {"q_min", q.q_min},
          {"q_mean", q.q_mean},
          {"angle_min", q.angle_min},
          {"angle_max", q.angle_max},
          {"angle_min_mean", q.angle_min_mean},
          {"below_30", q.below_30},
          {"degree_5_to_7", q.regular},
          {"euler_characteristic", q.euler_characteristic},
          {"boundary_loops", q.boundary_loops},
          {"manifold", q.manifold}};
}

nlohmann::json as_json(const RepairReport& r) {
  nlohmann::json all{{"acts", r.acts()},
                     {"left", r.left()},
                     {"moved", r.moved},
                     {"components", r.components},
                     {"boundary_edges", r.boundary_edges}};
  const std::pair<const char*, const RepairCount&> counts[] = {{"degenerate", r.degenerate},
                                                               {"repeated", r.repeated},
                                                               {"split_edges", r.split_edges},
                                                               {"split_vertices", r.split_vertices},
                                                               {"welded", r.welded},
                                                               {"turned", r.turned},
                                                               {"flat", r.flat},
                                                               {"left_flat", r.left_flat},
                                                               {"intersections", r.intersections}};
  for (const auto& [name, what] : counts) {
    all[name] = {{"count", what.count}};
    if (what.count > 0) all[name]["first"] = what.first;
  }
  return all;
}

nlohmann::json as_json(const RemeshArguments& arguments, const Outcome& o) {
  return {{"method", arguments.method},
          {"repair", as_json(o.repair)},
          {"input", as_json(o.before)},
          {"mesh", as_json(o.after)},
          {"diagonal", o.diagonal},
          {"hausdorff", {{"input_to_mesh", o.input_to_mesh}, {"mesh_to_input", o.mesh_to_input}}},
          {"rounds", o.result.least_spacing.size()},
          {"least_spacing", o.result.least_spacing},
          {"added", o.result.added},
          {"collapsed", o.result.collapsed},
          {"intersections", o.result.intersections.count},
          {"seconds",
           {{"read", o.read},
            {"repair", o.repairing},
            {"open", o.open},
            {"remesh", o.remesh},
            {"sample", o.result.seconds_sample},
            {"dual", o.result.seconds_dual},
            {"relax", o.result.seconds_relax},
            {"check", o.check},
            {"write", o.write},
            {"build", o.build},
            {"run", o.run}}},
          {"files", arguments.outputs},
          {"version", version()}};
}

void print_quality(const char* name, const MeshQuality& q) {
  fmt::print("{:6} {:>9} {:>9}  {:.3f}  {:.3f}  {:5.1f}  {:6.1f}  {:6.2f} %  {:6.2f} %  {:5}  {:5}{}\n", name,
             with_commas(q.vertices), with_commas(q.triangles), q.q_min, q.q_mean, q.angle_min, q.angle_max,
             100 * q.below_30, 100 * q.regular, q.euler_characteristic, q.boundary_loops,
             q.manifold ? "" : "  not a manifold");
}

void print(const RemeshArguments& arguments, const Outcome& o) {
  if (arguments.json) {
    fmt::print("{}\n", json_text(as_json(arguments, o)));
    return;
  }
  if (arguments.quiet) return;
  fmt::print("{:6} {:>9} {:>9}  {:>5}  {:>5}  {:>5}  {:>6}  {:>8}  {:>8}  {:>5}  {:>5}\n", "", "vertices",
             "triangles", "Q min", "mean", "angle", "max", "below 30", "deg. 5-7", "Euler", "loops");
  print_quality("before", o.before);
  print_quality("after", o.after);
  fmt::print("farthest from the input {:.3f} %, the input from it {:.3f} % of the diagonal\n",
             100 * o.mesh_to_input / o.diagonal, 100 * o.input_to_mesh / o.diagonal);
  for (const std::string& path : arguments.outputs) fmt::print("wrote {}\n", path);
  fmt::print(
      "{} rounds, least spacing {:.3f} of the sizing; {:.2f} s: sampling {:.2f}, dual {:.2f}, relaxation "
      "{:.2f}{}\n",
      o.result.least_spacing.size(), o.result.least_spacing.empty() ? 0 : o.result.least_spacing.back(),
      o.remesh, o.result.seconds_sample, o.result.seconds_dual, o.result.seconds_relax,
      building_note(o.build));
}

constexpr const char *repairing = "repairing the input", *remeshing = "remeshing",
                     *checking = "comparing both meshes";

/// The input as it is remeshed, with a line on standard error for each thing done to it.
TriangleMesh repaired(const RemeshArguments& arguments, TriangleMesh given, RepairReport& report,
                      Progress& progress) {
  progress.begin(repairing);
  if (arguments.no_repair) return given;
  RepairedMesh fixed = repair(given.vertices, given.triangles, {arguments.weld});
  report = fixed.report;
  print_notes(report.acts(), arguments.input, arguments, progress);
  std::vector<std::string> left;
  for (const std::string& what : report.left()) left.push_back("left as it is: " + what);
  print_notes(left, arguments.input, arguments, progress);
  return std::move(fixed.mesh);
}

/// A change of topology is a fault of the library; no file is written then.
void require_same_topology(const Outcome& o) {
  if (!o.after.manifold ||
      (o.before.manifold && (o.after.euler_characteristic != o.before.euler_characteristic ||
                             o.after.boundary_loops != o.before.boundary_loops)))
    throw Error(ErrorCode::internal,
                "the topology of the new mesh differs from that of the old one: please report");
}

/// Says on standard error what is not as usual in the new mesh.
void print_remarks(const RemeshArguments& arguments, const RemeshResult& result, Progress& progress) {
  std::vector<std::string> remarks;
  const auto place = [](const std::array<double, 3>& at) {
    return fmt::format("around ({:.9g}, {:.9g}, {:.9g})", at[0], at[1], at[2]);
  };
  if (result.collapsed)
    remarks.push_back((result.inseparable
                           ? "the surface is thin or sharp, or crosses itself, " + place(*result.inseparable)
                           : "the points are few for the topology and the kept edges") +
                      ": the mesh was made by collapsing edges of the input, not from cells");
  if (const std::size_t pairs = result.intersections.count; pairs > 0)
    remarks.push_back(
        fmt::format("{} of triangles of the new mesh cross{}, {}{}: more points may separate them",
                    pairs == 1 ? "1 pair" : with_commas(pairs) + " pairs", pairs == 1 ? "es" : "",
                    pairs == 1 ? "" : "the first ", place(result.intersections.first)));
  print_notes(remarks, arguments.input, arguments, progress);
}

/// \throw WrongUsage for options on pictures without one
io::PictureStyle picture_style_of(const RemeshArguments& arguments) {
  const CameraArguments& given = arguments.picture;
  const bool any = !(given.size + given.camera + given.up).empty();
  if (any && std::none_of(arguments.outputs.begin(), arguments.outputs.end(), io::is_picture))
    throw WrongUsage("--size, --camera and --up are for pictures; name one, such as -o view.png");
  io::PictureStyle style;
  style.size = picture_size(given, {.width = io::usual_width_of_two});
  set_camera(given, style.towards, style.up);
  return style;
}

void write_files(const RemeshArguments& arguments, const TriangleMesh& input, const TriangleMesh& mesh,
                 const io::PictureStyle& style) {
  for (const std::string& path : arguments.outputs) {
    if (io::lower_extension(path) == ".png")
      io::write_before_and_after(path, input, mesh, style);
    else
      io::write_triangles(path, mesh);
  }
}

/// \param device  output: stays open, since to close it takes time of its own
RemeshResult remesh_file(const RemeshArguments& arguments, const TriangleMesh& input, Progress& progress,
                         std::optional<Device>& device) {
  RemeshOptions options = arguments.remesh;
  options.repair = false;
  options.progress = progress.callback();
  const bool transport = arguments.method == "transport";
  options.method = transport ? RemeshMethod::transport : RemeshMethod::farthest_point;
  if (transport) {
    progress.begin(stage::opening);
    options.device = device = open_device(arguments);
  }
  progress.begin(remeshing);
  RemeshResult result;
  try {
    compute([&] { result = remesh(input.vertices, input.triangles, options); });
  } catch (const Error& error) {
    if (error.code() != ErrorCode::invalid_domain && error.code() != ErrorCode::invalid_argument) throw;
    throw Error(error.code(), fmt::format("{}: {}", arguments.input, error.what()));
  }
  return result;
}

void describe_times(const Progress& progress, Outcome& o) {
  o.read = progress.seconds(stage::reading);
  o.open = progress.seconds(stage::opening);
  o.repairing = progress.seconds(repairing);
  o.remesh = progress.seconds(remeshing);
  o.check = progress.seconds(checking);
  o.write = progress.seconds(stage::writing);
  o.build = progress.build();
  o.run = progress.run();
}

int run(const RemeshArguments& arguments) {
  check_writable(arguments.outputs, {arguments.report}, arguments.json);
  const io::PictureStyle style = picture_style_of(arguments);
  Outcome outcome;
  Progress progress({{stage::reading, 2},
                     {stage::opening, 1},
                     {repairing, 5},
                     {remeshing, 80},
                     {checking, 8},
                     {stage::writing, 4}},
                    arguments.silent());
  const io::LoadedDomain domain = io::read_domain(arguments.input, DomainKind::surface);
  outcome.diagonal = diagonal_of(domain.domain);
  const TriangleMesh input =
      repaired(arguments, {domain.vertices, domain.elements}, outcome.repair, progress);
  std::optional<Device> device;
  outcome.result = remesh_file(arguments, input, progress, device);
  progress.begin(checking);
  print_remarks(arguments, outcome.result, progress);
  const TriangleMesh& mesh = outcome.result.mesh;
  outcome.before = mesh_quality(input.vertices, input.triangles);
  outcome.after = mesh_quality(mesh.vertices, mesh.triangles);
  require_same_topology(outcome);
  outcome.input_to_mesh = farthest_from(input, mesh);
  outcome.mesh_to_input = farthest_from(mesh, input);
  progress.begin(stage::writing);
  write_files(arguments, input, mesh, style);
  progress.finish();
  describe_times(progress, outcome);
  if (!arguments.report.empty()) {
    io::AtomicFile file(arguments.report);
    file.write(json_text(as_json(arguments, outcome)) + "\n");
    file.commit();
  }
  print(arguments, outcome);
  return 0;
}

constexpr const char* remesh_examples =
    "Examples:\n"
    "  powercell remesh pretzel.off --count 5000 -o new.off -o before-and-after.png\n"
    "  powercell remesh part.stl --count 20000 --sharp-angle 30 -o part.ply --report quality.json\n"
    "  powercell remesh mesh.obj --count 5000 --method transport -o new.obj\n"
    "  powercell remesh torus:40 --count 3000 --contrast 1 -o even.obj --json\n"
    "Faces with more than three corners are triangulated. Faults that can be mended without a change of "
    "shape\n"
    "are: each is reported on standard error, as is what is left.";

void add_shape_options(CLI::App& command, RemeshOptions& options) {
  command.add_option("--contrast", options.contrast, "Largest ratio of edge lengths; 1 for an even mesh")
      ->capture_default_str();
  command.add_option("--gradation", options.gradation, "Largest growth of edge lengths per unit of length")
      ->capture_default_str();
  command
      .add_option("--sharp-angle", options.sharp_angle,
                  "Degrees: edges whose two normals differ by more are kept, as are boundaries")
      ->capture_default_str();
  command.add_option("--rounds", options.rounds, "Largest number of rounds of the method")
      ->capture_default_str();
  command.add_option("--relaxations", options.relaxations, "Rounds of the final relaxation")
      ->capture_default_str();
  command.add_option("--seed", options.random_seed, "Random seed; the same seed gives the same mesh")
      ->capture_default_str();
}

}  // namespace

Command add_remesh(CLI::App& app) {
  auto arguments = std::make_shared<RemeshArguments>();
  CLI::App* command = app.add_subcommand("remesh", "Remesh a surface with well-shaped triangles");
  command
      ->add_option(
          "input", arguments->input,
          "A surface: .off .obj .ply .stl .vtk .vtu .msh .mesh, or sphere, torus (with :N for resolution)")
      ->type_name("FILE|SHAPE")
      ->check(known_words({"sphere", "torus"}))
      ->required();
  command->add_option("--count", arguments->remesh.count, "Vertices of the new mesh")->required();
  command
      ->add_option("--method", arguments->method,
                   "fpo: farthest-point optimisation; transport: cells of equal mass, faster")
      ->check(one_of({"fpo", "transport"}))
      ->capture_default_str();
  add_shape_options(*command, arguments->remesh);
  add_output_files(*command, arguments->outputs,
                   std::string(io::triangle_files) + " for the mesh, .png for both meshes side by side",
                   io::check_triangle_output);
  add_camera_options(*command, arguments->picture, io::usual_width_of_two);
  command->add_flag("--no-repair", arguments->no_repair,
                    "Take edges as one where vertices have the same number, and refuse what is no manifold");
  command->add_option("--weld", arguments->weld, "Largest distance over which boundary edges are joined")
      ->default_str("10^-6 of the diagonal, or the rounding of single precision")
      ->check(not_below_zero());
  command->add_option("--report", arguments->report, "Write the figures as JSON")
      ->type_name("FILE.json")
      ->default_str("none");
  add_device_option(*command, *arguments, "For transport: ");
  add_threads_option(*command, *arguments, "For transport: ");
  add_output_options(*command, *arguments);
  command->footer(remesh_examples);
  return [arguments] { return run(*arguments); };
}

}  // namespace powercell::app
