// remesh(): from the input mesh to the new one.
#include <algorithm>
#include <memory>
#include <powercell/error.hpp>
#include <powercell/remeshing.hpp>
#include <string>
#include <utility>

#include "lib/applications/remeshing/dual.hpp"
#include "lib/applications/remeshing/equal_mass.hpp"
#include "lib/applications/remeshing/farthest.hpp"
#include "lib/applications/remeshing/frame.hpp"
#include "lib/applications/remeshing/mesh_check.hpp"
#include "lib/applications/remeshing/relax.hpp"
#include "lib/applications/remeshing/repair_steps.hpp"
#include "lib/applications/remeshing/work_mesh.hpp"
#include "lib/base/float_environment.hpp"
#include "lib/base/text.hpp"
#include "lib/base/work_clock.hpp"

namespace powercell {
namespace {

// More passes bring the mesh closer to the surface at the cost of shape (docs/applications.md).
constexpr int fit_passes = 2;
// Of positions of the new mesh, in units of its frame.
constexpr double rounding = 1e-12;

using namespace remeshing;

void check(const RemeshOptions& o) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw Error(ErrorCode::invalid_argument, what);
  };
  require(o.count >= 4, "too few points: a surface needs at least 4");
  require(o.count < 0x7fffffff, "more points than 31 bits can number");
  require(o.gradation > 0 && o.gradation <= 10, "the gradation must be above 0 and at most 10");
  require(o.contrast >= 1 && o.contrast <= 1000, "the contrast must be from 1 to 1000");
  require(o.sharp_angle > 0 && o.sharp_angle <= 180,
          "the sharp angle must be above 0 and at most 180 degrees");
  require(o.rounds >= 0 && o.relaxations >= 0, "rounds must not be negative");
}

/// Refuses surfaces whose triangles, cut to the length of the new edges, would be far more than the new mesh
/// has: without a limit for triangles far longer than wide.
void check_thinness(const Surface& input, double spacing, std::size_t count) {
  const double triangles = refined_size(input, spacing);
  if (triangles <= 1e5 + 400 * static_cast<double>(count + input.size())) return;
  throw Error(ErrorCode::invalid_domain, "the surface is too thin for a mesh of " + std::to_string(count) +
                                             " points: cut to their spacing, its triangles would be about " +
                                             digits(triangles, 2));
}

void store(const WorkMesh& mesh, const Frame& frame, RemeshResult& result) {
  std::vector<std::uint32_t> number(mesh.vertex_count(), nothing);
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.is_alive(v)) continue;
    number[v] = static_cast<std::uint32_t>(result.sizing.size());
    const Vec at = frame.back(mesh.at(v));
    result.mesh.vertices.insert(result.mesh.vertices.end(), {at.x, at.y, at.z});
    result.fixed.push_back(mesh.vertex(v).kind != Hold::Kind::free);
    result.sizing.push_back(mesh.vertex(v).h * frame.length);
  }
  for (const WorkMesh::Corners& row : mesh.triangles())
    if (row[0] != row[1])
      for (const std::uint32_t v : row) result.mesh.triangles.push_back(number[v]);
}

std::unique_ptr<Sampling> sample(const Surface& surface, const Sizing& sizing,
                                 const std::vector<Curve>& curves, const RemeshOptions& options,
                                 RemeshResult& result, Progress progress) {
  auto sampling = std::make_unique<Sampling>(surface, sizing, curves, options.random_seed);
  sampling->place_on_curves(options.count);
  fill_farthest(*sampling, options.count, progress);
  if (options.method == RemeshMethod::farthest_point) {
    result.least_spacing = optimise_farthest(*sampling, options.rounds, progress);
    return sampling;
  }
  const Device device = options.device ? *options.device : Device::choose();
  const std::vector<Place> places = equalise_masses(*sampling, sizing, device, options.rounds, progress);
  sampling = std::make_unique<Sampling>(surface, sizing, curves, options.random_seed);
  sampling->place_on_curves(options.count);
  progress.at(1);
  for (const Place& place : places) {
    progress.tick();
    sampling->add_free(place);
  }
  result.least_spacing = {sampling->least_spacing()};
  return sampling;
}

/// The dual of the cells, or, if it does not get the topology of the surface or cannot have so few vertices,
/// the triangles of the surface with edges collapsed.
WorkMesh mesh_of(Sampling& sampling, const Sizing& sizing, const std::vector<Curve>& curves,
                 std::size_t count, RemeshResult& result, Progress progress) {
  const Surface& surface = sampling.diagram().surface();
  Place left;
  if (const std::optional<DualMesh> dual = mend(sampling, 2 * count + 200, left, progress)) {
    result.added = sampling.diagram().alive() - count;
    progress.at(0);
    WorkMesh mesh(sampling, *dual);
    if (reach_count(mesh, surface, sizing, count, progress)) return mesh;
  } else {
    const Vec at = surface.frame.back(left.at);
    result.inseparable = {{at.x, at.y, at.z}};
  }
  result.collapsed = true;
  result.added = 0;
  WorkMesh mesh(surface, sizing, curves);
  if (reach_count(mesh, surface, sizing, count, progress)) return mesh;
  throw Error(ErrorCode::invalid_argument,
              "too few points for the topology and the corners of the surface: collapsing its edges left " +
                  std::to_string(mesh.alive()) + " vertices of " + std::to_string(count));
}

}  // namespace

RemeshResult remesh(std::span<const double> vertices, std::span<const std::uint32_t> triangles,
                    const RemeshOptions& options) {
  const FloatEnvironment environment;
  check(options);
  RemeshResult result;
  WorkClock watch;
  const Progress all(options.progress);
  all.part(0, 0).at(0);
  RepairedMesh repaired;
  if (options.repair) {
    repaired = repair(vertices, triangles);
    result.repair = repaired.report;
    vertices = repaired.mesh.vertices;
    triangles = repaired.mesh.triangles;
  } else {
    check_triangles(vertices, triangles);
  }
  const Frame frame = frame_of(vertices, triangles);
  const Surface input = make_surface(vertices, triangles, options.sharp_angle, frame);
  const double spacing = even_spacing(input, options.count);
  check_thinness(input, spacing, options.count);
  std::vector<double> shape = relative_sizing(input, spacing, options.contrast, all.part(0, 0.01));
  const Surface surface = refined(input, spacing, shape);
  const Sizing sizing = scaled_sizing(surface, shape, options.gradation, options.count, all.part(0.01, 0.02));

  const std::vector<Curve> curves = kept_curves(surface, options.sharp_angle);
  const std::unique_ptr<Sampling> sampling =
      sample(surface, sizing, curves, options, result, all.part(0.02, 0.9));
  result.seconds_sample = watch.lap();

  WorkMesh mesh = mesh_of(*sampling, sizing, curves, options.count, result, all.part(0.9, 0.9));
  result.seconds_dual = watch.lap();

  relax(mesh, surface, sizing, options.relaxations, all.part(0.9, 0.97));
  if (options.relaxations > 0) fit(mesh, surface, sizing, fit_passes, all.part(0.97, 1));
  all.part(1, 1).at(0);
  store(mesh, frame, result);
  result.intersections =
      crossings(patchwork_of(result.mesh.vertices, result.mesh.triangles), rounding * frame.length);
  result.seconds_relax = watch.lap();
  return result;
}

}  // namespace powercell
