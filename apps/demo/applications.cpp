// What is built on diagrams, in the demo: a treemap, stipples and a new mesh.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <powercell/remeshing.hpp>
#include <powercell/repair.hpp>

#include "apps/demo/parts.hpp"
#include "apps/interrupt.hpp"
#include "apps/io/picture/picture.hpp"
#include "apps/io/read/domain.hpp"
#include "apps/io/tables/read_tree.hpp"
#include "apps/io/write/points.hpp"
#include "apps/io/write/treemap.hpp"
#include "apps/io/write/triangles.hpp"
#include "apps/sampling/source.hpp"
#include "apps/treemap_shape.hpp"

namespace powercell::app {
namespace {

constexpr std::size_t stipples = 4000, vertices = 1000;

std::string in_folder(const DemoSetting& setting, const char* file) {
  return (setting.folder / file).string();
}

const auto not_interrupted = [](const auto&) { return !interrupted(); };

}  // namespace

DemoPart draw_treemap(const DemoSetting& setting, const Device*) {
  const io::NamedTree tree = io::read_tree(in_folder(setting, "italy_regions.csv"));
  std::vector<std::string> notes;
  const Ring outline = treemap_shape("3:2", notes);
  TreemapOptions options;
  options.threads = setting.options.threads;
  options.progress = not_interrupted;
  Treemap map;
  compute([&] { map = treemap({tree.parent, tree.value}, outline, options); });
  if (!map.not_converged.empty())
    throw Error(ErrorCode::not_converged,
                "the areas of the demo's treemap are not as they should be: please report");
  const std::vector<std::int64_t> hue = io::number_branches(map, {}),
                                  shade = io::number_groups(map, tree.parent, {});
  DemoPart part;
  part.files = {in_folder(setting, "treemap.png"), in_folder(setting, "treemap.svg")};
  for (const std::string& path : part.files) io::write_treemap(path, {tree, map, hue, shade});

  part.name = "treemap";
  part.title = "Cells of given sizes";
  part.caption =
      "The people of Italy’s regions: the area of each cell is their number. Weights that give cells their "
      "sizes are "
      "found by optimal transport, here level by level; 'powercell transport' finds them for any domain. "
      "There are no "
      "discs: the cells are the data.";
  part.shown = "A rectangle divided into five parts of Italy and those into regions, each with its name";
  part.command = "powercell treemap italy_regions.csv --shape 3:2 -o treemap.png";
  part.topic = "treemap";
  part.document = "docs/applications.md#treemap";
  part.document_title = "Treemap";
  part.figures = {{"cells", with_commas(map.leaves)},
                  {"areas right to", fmt::format("{:.1e}", map.worst_error)}};
  part.line = fmt::format("{} cells, areas right to {:.1e}", map.leaves, map.worst_error);
  part.report = {{"leaves", map.leaves}, {"worst_leaf_error", map.worst_error}};
  return part;
}

DemoPart draw_stipples(const DemoSetting& setting, const Device* device) {
  SourceArguments arguments;
  arguments.image = in_folder(setting, "photo.png");
  const Source source = read_source(arguments);
  SamplingOptions options;
  options.density = source.density;
  options.diagram = library_options(setting.options);
  options.progress = not_interrupted;
  SamplingResult points;
  compute([&] { points = sample(*device, source.domain, stipples, options); });
  if (!points.converged)
    throw Error(ErrorCode::not_converged,
                "the stipples of the demo are not as even as they should be: please report");
  const std::vector<double> radii = dot_radii(*device, source, points);
  DemoPart part;
  part.files = {in_folder(setting, "stipples.png"), in_folder(setting, "stipples.svg")};
  for (const std::string& path : part.files)
    io::write_points(path, {source.domain, points.positions, points.weights, points.mass, radii});

  part.name = "stipples";
  part.title = "A picture in dots";
  part.caption = fmt::format(
      "A gray picture in {} dots. Each dot is a seed whose cell holds as much darkness as every other cell, "
      "so dots are "
      "dense where the picture is dark; each has the ink of its cell. Even but irregular: blue noise.",
      with_commas(stipples));
  part.shown = "Three balls on a chequered table, drawn with black dots";
  part.command = fmt::format("powercell sample --image photo.png -n {} -o stipples.png", stipples);
  part.topic = "sample";
  part.document = "docs/applications.md#sampling";
  part.document_title = "Sampling";
  part.figures = {{"dots", with_commas(stipples)},
                  {"iterations", with_commas(static_cast<std::size_t>(points.steps.back().iteration))},
                  {"masses equal to", fmt::format("{:.1e}", points.capacity_error)}};
  part.line = fmt::format("{} dots, {} iterations, masses equal to {:.1e}", with_commas(stipples),
                          points.steps.back().iteration, points.capacity_error);
  part.report = {{"points", stipples},
                 {"iterations", points.steps.back().iteration},
                 {"capacity_error", points.capacity_error}};
  return part;
}

DemoPart draw_mesh(const DemoSetting& setting, const Device*) {
  const io::LoadedDomain domain = io::read_domain(in_folder(setting, "pretzel.off"), DomainKind::surface);
  const TriangleMesh input = repair(domain.vertices, domain.elements).mesh;
  RemeshOptions options;
  options.count = vertices;
  options.repair = false;
  options.progress = not_interrupted;
  RemeshResult result;
  compute([&] { result = remesh(input.vertices, input.triangles, options); });
  const MeshQuality before = mesh_quality(input.vertices, input.triangles);
  const MeshQuality after = mesh_quality(result.mesh.vertices, result.mesh.triangles);
  if (!after.manifold || after.euler_characteristic != before.euler_characteristic)
    throw Error(ErrorCode::internal,
                "the topology of the demo's new mesh differs from that of the old one: please report");
  DemoPart part;
  part.files = {in_folder(setting, "remesh.png"), in_folder(setting, "remesh.off")};
  io::write_before_and_after(part.files[0], input, result.mesh, {.size = {.width = io::usual_width_of_two}});
  io::write_triangles(part.files[1], result.mesh);

  part.name = "remesh";
  part.title = "A new mesh of a surface";
  part.caption = fmt::format(
      "The surface of before, left as it was given and right with {} vertices: seeds are spread over it, and "
      "its new "
      "triangles join those whose cells touch. Triangles are smaller where the surface is curved.",
      with_commas(vertices));
  part.shown = "The pretzel twice, with long thin triangles on the left and even ones on the right";
  part.command = fmt::format("powercell remesh pretzel.off --count {} -o remesh.png", vertices);
  part.topic = "remesh";
  part.document = "docs/applications.md#remeshing";
  part.document_title = "Remeshing";
  part.figures = {{"triangles", with_commas(after.triangles)},
                  {"least angle", fmt::format("{:.0f}°, was {:.0f}°", after.angle_min, before.angle_min)},
                  {"mean quality", fmt::format("{:.2f}, was {:.2f}", after.q_mean, before.q_mean)}};
  part.line = fmt::format(
      "{} triangles, least angle {:.0f} degrees (was {:.0f}), mean quality {:.2f} (was {:.2f})",
      with_commas(after.triangles), after.angle_min, before.angle_min, after.q_mean, before.q_mean);
  part.report = {{"vertices", after.vertices},
                 {"triangles", after.triangles},
                 {"angle_min", after.angle_min},
                 {"q_mean", after.q_mean}};
  return part;
}

}  // namespace powercell::app
