// Repair, remeshing and treemaps of the C interface.
#include <algorithm>
#include <cmath>
#include <limits>
#include <powercell/powercell.hpp>
#include <stdexcept>

#include "tests/c_api/handles.hpp"

using namespace powercell::c_api_test;

namespace {

using Repaired = Owned<const pc_repaired_mesh, pc_repaired_mesh_destroy>;
using Remeshed = Owned<const pc_remesh_result, pc_remesh_result_destroy>;
using Quality = Owned<const pc_mesh_quality, pc_mesh_quality_destroy>;
using Layout = Owned<const pc_treemap, pc_treemap_destroy>;

const double square[8] = {0, 0, 1, 0, 1, 1, 0, 1};

}  // namespace

TEST_CASE("repair does and reports what it does in C++") {
  // Two triangles of a square without common vertices, the second turned, and one without area.
  const std::vector<double> vertices = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0};
  const std::vector<uint32_t> triangles = {0, 1, 2, 3, 5, 4, 0, 0, 1};
  Repaired mesh;
  REQUIRE(pc_repair(vertices.data(), 6, triangles.data(), 3, -1, &mesh.handle) == PC_OK);
  const powercell::RepairedMesh expected = powercell::repair(vertices, triangles);
  REQUIRE(mesh->triangle_count * 3 == expected.mesh.triangles.size());
  CHECK(std::equal(expected.mesh.triangles.begin(), expected.mesh.triangles.end(), mesh->triangles));
  CHECK(mesh->vertex_count * 3 == expected.mesh.vertices.size());
  const pc_repair_report& report = *mesh->report;
  CHECK(report.changed == 1);
  CHECK(report.degenerate.count == 1);
  CHECK(report.turned.count == expected.report.turned.count);
  CHECK(report.components == 1);
  CHECK(report.boundary_edges == 4);
  REQUIRE(report.act_count == expected.report.acts().size());
  CHECK(report.acts[0] == expected.report.acts()[0]);
  CHECK(report.left_count == 0);
  const pc_repaired_mesh* none = nullptr;
  CHECK(pc_repair(vertices.data(), 6, triangles.data(), 3, nan_value, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_repair(nullptr, 6, triangles.data(), 3, -1, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_repair(vertices.data(), 5, triangles.data(), 3, -1, &none) == PC_INVALID_DOMAIN);
  CHECK(pc_repair(vertices.data(), 6, triangles.data(), 3, -1, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(none == nullptr);
}

TEST_CASE("a new mesh of a sphere has the vertices asked for, and the bits of C++") {
  const powercell::TriangleMesh sphere = powercell::sphere(4);
  const std::size_t nv = sphere.vertices.size() / 3, nt = sphere.triangles.size() / 3;
  pc_remesh_options options;
  REQUIRE(pc_remesh_options_init(&options, sizeof options) == PC_OK);
  CHECK(options.count == 5000);
  CHECK(options.repair == 1);
  options.count = 60;
  options.rounds = 2;
  double done = 0;
  options.progress = [](double fraction, void* user) {
    *static_cast<double*>(user) = fraction;
    return 1;
  };
  options.progress_user = &done;
  Remeshed mesh;
  REQUIRE(pc_remesh(sphere.vertices.data(), nv, sphere.triangles.data(), nt, &options, &mesh.handle) ==
          PC_OK);
  powercell::RemeshOptions same;
  same.count = 60;
  same.rounds = 2;
  const powercell::RemeshResult expected = powercell::remesh(sphere.vertices, sphere.triangles, same);
  REQUIRE(mesh->vertex_count == 60);
  CHECK(std::equal(expected.mesh.vertices.begin(), expected.mesh.vertices.end(), mesh->vertices));
  CHECK(std::equal(expected.mesh.triangles.begin(), expected.mesh.triangles.end(), mesh->triangles));
  CHECK(std::equal(expected.sizing.begin(), expected.sizing.end(), mesh->sizing));
  CHECK(mesh->round_count == expected.least_spacing.size());
  CHECK(std::count(mesh->fixed, mesh->fixed + 60, 0) == 60);
  CHECK(mesh->repair->changed == 0);
  CHECK(mesh->has_inseparable == 0);
  CHECK(done > 0);

  Quality quality;
  REQUIRE(pc_mesh_quality_create(mesh->vertices, 60, mesh->triangles, mesh->triangle_count,
                                 &quality.handle) == PC_OK);
  CHECK(quality->euler_characteristic == 2);
  CHECK(quality->manifold == 1);
  CHECK(quality->q_mean == powercell::mesh_quality(expected.mesh.vertices, expected.mesh.triangles).q_mean);
  double distance = -1;
  REQUIRE(pc_farthest_from(mesh->vertices, 60, mesh->triangles, mesh->triangle_count, sphere.vertices.data(),
                           nv, sphere.triangles.data(), nt, 1000, &distance) == PC_OK);
  CHECK(distance == powercell::farthest_from(expected.mesh, sphere, 1000));

  const pc_remesh_result* none = nullptr;
  const auto run = [&] {
    return pc_remesh(sphere.vertices.data(), nv, sphere.triangles.data(), nt, &options, &none);
  };
  options.progress = [](double, void*) -> int { throw std::runtime_error("enough"); };
  CHECK(run() == PC_INTERRUPTED);
  CHECK(message_has("enough"));
  REQUIRE(pc_remesh_options_init(&options, sizeof options) == PC_OK);
  options.method = static_cast<pc_remesh_method>(5);
  CHECK(run() == PC_INVALID_ARGUMENT);
  REQUIRE(pc_remesh_options_init(&options, sizeof options) == PC_OK);
  options.contrast = nan_value;
  CHECK(run() == PC_INVALID_ARGUMENT);
  options.struct_size = 0;
  CHECK(run() == PC_INVALID_ARGUMENT);
  CHECK(pc_remesh_options_init(&options, sizeof options - 1) == PC_INVALID_ARGUMENT);
  CHECK(pc_remesh(nullptr, nv, sphere.triangles.data(), nt, nullptr, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_remesh(sphere.vertices.data(), nv, nullptr, nt, nullptr, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_remesh(sphere.vertices.data(), nv, sphere.triangles.data(), nt, nullptr, nullptr) ==
        PC_INVALID_ARGUMENT);
  CHECK(none == nullptr);
  const pc_mesh_quality* no_quality = nullptr;
  CHECK(pc_mesh_quality_create(nullptr, nv, sphere.triangles.data(), nt, &no_quality) == PC_INVALID_ARGUMENT);
  CHECK(pc_mesh_quality_create(sphere.vertices.data(), 2, sphere.triangles.data(), nt, &no_quality) ==
        PC_INVALID_DOMAIN);
  CHECK(no_quality == nullptr);
  CHECK(pc_farthest_from(nullptr, 3, nullptr, 1, nullptr, 3, nullptr, 1, 0, &distance) ==
        PC_INVALID_ARGUMENT);
  CHECK(pc_farthest_from(nullptr, 0, nullptr, 0, nullptr, 0, nullptr, 0, 0, nullptr) == PC_INVALID_ARGUMENT);
}

TEST_CASE("a treemap has the values as areas, and can start from an earlier one") {
  const int64_t parent[6] = {PC_NO_PARENT, 0, 0, 1, 1, 1};
  const double value[6] = {0, 0, 4, 1, 2, 3};
  Layout layout, again;
  REQUIRE(pc_treemap_create(parent, value, 6, square, 4, nullptr, &layout.handle) == PC_OK);
  REQUIRE(layout->count == 6);
  CHECK(layout->kind[0] == PC_NODE_GROUP);
  CHECK(layout->kind[2] == PC_NODE_LEAF);
  CHECK(layout->leaves == 4);
  CHECK(layout->value[0] == 10);
  CHECK(layout->depth[5] == 2);
  CHECK(layout->worst_error < 1e-6);
  CHECK(layout->not_converged_count == 0);
  double area = 0;
  const uint64_t first = layout->vertex_offset[5], last = layout->vertex_offset[6];
  for (uint64_t k = first; k < last; ++k) {
    const double* a = layout->vertices + 2 * k;
    const double* b = layout->vertices + 2 * (k + 1 < last ? k + 1 : first);
    area += (a[0] * b[1] - a[1] * b[0]) / 2;
  }
  CHECK(area == doctest::Approx(0.3).epsilon(1e-5));

  std::vector<double> start(12);
  REQUIRE(pc_treemap_relative_positions(parent, layout->seeds, 6, layout->vertex_offset, layout->vertices,
                                        start.data()) == PC_OK);
  pc_treemap_options options;
  REQUIRE(pc_treemap_options_init(&options, sizeof options) == PC_OK);
  options.start = start.data();
  options.rounds = 0;
  REQUIRE(pc_treemap_create(parent, value, 6, square, 4, &options, &again.handle) == PC_OK);
  CHECK(again->seeds[4] == doctest::Approx(layout->seeds[4]).epsilon(1e-6));

  // Errors name nodes as the caller does.
  const char* const names[6] = {"all", "left", "right", "a", "b", "c"};
  const double wrong[6] = {0, 0, 4, 1, 2, nan_value};
  REQUIRE(pc_treemap_options_init(&options, sizeof options) == PC_OK);
  options.names = names;
  const pc_treemap* none = nullptr;
  CHECK(pc_treemap_create(parent, wrong, 6, square, 4, &options, &none) == PC_INVALID_ARGUMENT);
  CHECK(message_has("c"));
  const char* const missing[6] = {"all", nullptr, "right", "a", "b", "c"};
  options.names = missing;
  CHECK(pc_treemap_create(parent, value, 6, square, 4, &options, &none) == PC_INVALID_ARGUMENT);
  CHECK(message_has("names"));
  REQUIRE(pc_treemap_options_init(&options, sizeof options) == PC_OK);
  options.progress = [](double, void*) { return 0; };
  CHECK(pc_treemap_create(parent, value, 6, square, 4, &options, &none) == PC_INTERRUPTED);
  options.struct_size = 7;
  CHECK(pc_treemap_create(parent, value, 6, square, 4, &options, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_treemap_options_init(nullptr, sizeof options) == PC_INVALID_ARGUMENT);
  CHECK(pc_treemap_create(nullptr, value, 6, square, 4, nullptr, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_treemap_create(parent, nullptr, 6, square, 4, nullptr, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_treemap_create(parent, value, 6, nullptr, 4, nullptr, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_treemap_create(parent, value, 6, square, 2, nullptr, &none) == PC_INVALID_DOMAIN);
  CHECK(pc_treemap_create(parent, value, 6, square, 4, nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(none == nullptr);
  CHECK(pc_treemap_relative_positions(nullptr, layout->seeds, 6, layout->vertex_offset, layout->vertices,
                                      start.data()) == PC_INVALID_ARGUMENT);
  CHECK(pc_treemap_relative_positions(parent, layout->seeds, 6, layout->vertex_offset, layout->vertices,
                                      nullptr) == PC_INVALID_ARGUMENT);
}
