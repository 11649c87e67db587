#include <powercell/c/remeshing.h>

#include <powercell/remeshing.hpp>

#include "lib/c_api/handles.hpp"
#include "lib/c_api/options.hpp"
#include "lib/c_api/results.hpp"

namespace powercell::c_api {
namespace {

static_assert(static_cast<int>(RemeshMethod::transport) == PC_REMESH_TRANSPORT);

/// A report as a struct of C, with the sentences that it points to.
struct Report {
  std::vector<std::string> acts, left;
  std::vector<const char*> act_pointers, left_pointers;
  pc_repair_report view;
};

struct Repaired {
  RepairedMesh repaired;
  Report report;
};

struct Remeshed {
  RemeshResult result;
  std::vector<std::uint8_t> fixed;
  Report report;
};

struct NoOwner {};

pc_repair_count view_of(const RepairCount& from) {
  return {from.count, {from.first[0], from.first[1], from.first[2]}};
}

/// `to` must stay where it is.
void fill(Report& to, const RepairReport& from) {
  to.acts = from.acts();
  to.left = from.left();
  for (const std::string& act : to.acts) to.act_pointers.push_back(act.c_str());
  for (const std::string& left : to.left) to.left_pointers.push_back(left.c_str());
  pc_repair_report& view = to.view;
  view.degenerate = view_of(from.degenerate);
  view.repeated = view_of(from.repeated);
  view.split_edges = view_of(from.split_edges);
  view.split_vertices = view_of(from.split_vertices);
  view.welded = view_of(from.welded);
  view.moved = from.moved;
  view.turned = view_of(from.turned);
  view.flat = view_of(from.flat);
  view.left_flat = view_of(from.left_flat);
  view.intersections = view_of(from.intersections);
  view.components = from.components;
  view.boundary_edges = from.boundary_edges;
  view.changed = from.changed();
  view.act_count = to.acts.size();
  view.acts = pointer(to.act_pointers);
  view.left_count = to.left.size();
  view.left = pointer(to.left_pointers);
}

/// Sets the members of a mesh that several structs have.
template <class View>
void fill_mesh(View& to, const TriangleMesh& from) {
  to.vertex_count = from.vertices.size() / 3;
  to.triangle_count = from.triangles.size() / 3;
  to.vertices = pointer(from.vertices);
  to.triangles = pointer(from.triangles);
}

void fill_remeshed(pc_remesh_result& to, Remeshed& of) {
  const RemeshResult& from = of.result;
  of.fixed.assign(from.fixed.begin(), from.fixed.end());
  fill(of.report, from.repair);
  fill_mesh(to, from.mesh);
  to.repair = &of.report.view;
  to.fixed = pointer(of.fixed);
  to.sizing = pointer(from.sizing);
  to.round_count = from.least_spacing.size();
  to.least_spacing = pointer(from.least_spacing);
  to.added = from.added;
  to.collapsed = from.collapsed;
  to.has_inseparable = from.inseparable.has_value();
  if (from.inseparable) std::copy(from.inseparable->begin(), from.inseparable->end(), to.inseparable);
  to.intersections = view_of(from.intersections);
  to.seconds_sample = from.seconds_sample;
  to.seconds_dual = from.seconds_dual;
  to.seconds_relax = from.seconds_relax;
}

pc_remesh_options defaults() {
  const RemeshOptions from;
  pc_remesh_options to{};
  to.repair = from.repair;
  to.count = from.count;
  to.gradation = from.gradation;
  to.contrast = from.contrast;
  to.sharp_angle = from.sharp_angle;
  to.rounds = from.rounds;
  to.relaxations = from.relaxations;
  to.random_seed = from.random_seed;
  return to;
}

RemeshOptions remesh_options(const pc_remesh_options* options) {
  const pc_remesh_options from = current(options, defaults(), "pc_remesh_options");
  RemeshOptions to;
  to.method = value_of<RemeshMethod>(from.method, PC_REMESH_TRANSPORT, "options.method", "pc_remesh_method");
  to.count = from.count;
  to.gradation = from.gradation;
  to.contrast = from.contrast;
  to.sharp_angle = from.sharp_angle;
  to.rounds = from.rounds;
  to.relaxations = from.relaxations;
  to.random_seed = from.random_seed;
  to.repair = from.repair != 0;
  if (from.device) to.device = from.device->device;
  to.progress = progress_of(from.progress, from.progress_user);
  return to;
}

std::span<const double> points(const double* vertices, size_t count) {
  return rows_view(vertices, count, 3, "vertices");
}
std::span<const std::uint32_t> corners(const uint32_t* triangles, size_t count) {
  return rows_view(triangles, count, 3, "triangles");
}
TriangleMesh mesh_of(const double* vertices, size_t vertex_count, const uint32_t* triangles,
                     size_t triangle_count) {
  const auto positions = points(vertices, vertex_count);
  const auto indices = corners(triangles, triangle_count);
  return {{positions.begin(), positions.end()}, {indices.begin(), indices.end()}};
}

}  // namespace

}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

extern "C" {

pc_status pc_repair(const double* vertices, size_t vertex_count, const uint32_t* triangles,
                    size_t triangle_count, double weld, const pc_repaired_mesh** mesh) {
  return guarded([&] {
    result_at(mesh);
    RepairedMesh repaired =
        repair(points(vertices, vertex_count), corners(triangles, triangle_count), {weld});
    hand_over_result(mesh, Repaired{std::move(repaired), {}}, [](pc_repaired_mesh& to, Repaired& from) {
      fill(from.report, from.repaired.report);
      fill_mesh(to, from.repaired.mesh);
      to.report = &from.report.view;
    });
  });
}

void pc_repaired_mesh_destroy(const pc_repaired_mesh* mesh) {
  destroy_result<Repaired>(mesh);
}

pc_status pc_remesh_options_init(pc_remesh_options* options, size_t struct_size) {
  return init(options, struct_size, defaults(), "pc_remesh_options");
}

pc_status pc_remesh(const double* vertices, size_t vertex_count, const uint32_t* triangles,
                    size_t triangle_count, const pc_remesh_options* options,
                    const pc_remesh_result** result) {
  return guarded([&] {
    result_at(result);
    RemeshResult made =
        remesh(points(vertices, vertex_count), corners(triangles, triangle_count), remesh_options(options));
    hand_over_result(result, Remeshed{std::move(made), {}, {}}, fill_remeshed);
  });
}

void pc_remesh_result_destroy(const pc_remesh_result* result) {
  destroy_result<Remeshed>(result);
}

pc_status pc_mesh_quality_create(const double* vertices, size_t vertex_count, const uint32_t* triangles,
                                 size_t triangle_count, const pc_mesh_quality** quality) {
  return guarded([&] {
    result_at(quality);
    const MeshQuality q = mesh_quality(points(vertices, vertex_count), corners(triangles, triangle_count));
    hand_over_result(quality, NoOwner{}, [&](pc_mesh_quality& to, NoOwner&) {
      to = {q.vertices,       q.triangles,      q.q_min,    q.q_mean,  q.angle_min,
            q.angle_max,      q.angle_min_mean, q.below_30, q.regular, q.euler_characteristic,
            q.boundary_loops, q.manifold};
    });
  });
}

void pc_mesh_quality_destroy(const pc_mesh_quality* quality) {
  destroy_result<NoOwner>(quality);
}

pc_status pc_farthest_from(const double* vertices_a, size_t vertex_count_a, const uint32_t* triangles_a,
                           size_t triangle_count_a, const double* vertices_b, size_t vertex_count_b,
                           const uint32_t* triangles_b, size_t triangle_count_b, size_t samples,
                           double* distance) {
  return guarded([&] {
    result_at(distance);
    const TriangleMesh a = mesh_of(vertices_a, vertex_count_a, triangles_a, triangle_count_a);
    const TriangleMesh b = mesh_of(vertices_b, vertex_count_b, triangles_b, triangle_count_b);
    *distance = samples == 0 ? farthest_from(a, b) : farthest_from(a, b, samples);
  });
}

}  // extern "C"
