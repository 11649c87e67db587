// Domains, devices, shapes and options of the C interface.
#include <algorithm>
#include <array>
#include <powercell/powercell.hpp>
#include <powercell/regions.hpp>

#include "lib/c_api/options.hpp"
#include "tests/c_api/handles.hpp"

using namespace powercell::c_api_test;

namespace {

// An options struct in its first version, and as a later one would have it.
struct First {
  size_t struct_size;
  int chosen;
  int other;
};
struct Later {
  size_t struct_size;
  int chosen;
  int other;
  double added;
};

}  // namespace

template <>
struct powercell::c_api::KnownSizes<Later> {
  static constexpr std::array<std::size_t, 2> values{sizeof(First), sizeof(Later)};
};

TEST_CASE("programs of an earlier version get defaults for the members that they do not know") {
  using namespace powercell::c_api;
  const Later defaults{0, 1, 2, 0.5};
  struct {
    First options;
    double behind;
  } caller{{}, -1};
  REQUIRE(init(reinterpret_cast<Later*>(&caller.options), sizeof(First), defaults, "later") == PC_OK);
  CHECK(caller.behind == -1);  // nothing was written behind the struct
  CHECK(caller.options.other == 2);
  caller.options.chosen = 7;
  const Later read = current(reinterpret_cast<const Later*>(&caller.options), defaults, "later");
  CHECK(read.chosen == 7);
  CHECK(read.other == 2);
  CHECK(read.added == 0.5);
}

TEST_CASE("options of an unknown size are refused, by name") {
  pc_options options;
  CHECK(pc_options_init(&options, sizeof options - 8) == PC_INVALID_ARGUMENT);
  CHECK(pc_options_init(&options, sizeof options + 8) == PC_INVALID_ARGUMENT);
  CHECK(message_has("pc_options"));
  CHECK(pc_options_init(nullptr, sizeof options) == PC_INVALID_ARGUMENT);
  REQUIRE(pc_options_init(&options, sizeof options) == PC_OK);
  CHECK(options.struct_size == sizeof options);
  CHECK(options.twin_queries == 1);

  Grid f;
  pc_diagram* diagram = nullptr;
  for (const size_t size : {size_t{0}, sizeof options - 1, sizeof options + 8}) {
    options.struct_size = size;
    CHECK(pc_diagram_create(shared_device(), f.domain.handle, &options, &diagram) == PC_INVALID_ARGUMENT);
    CHECK(message_has("pc_options_init"));
  }
  CHECK(diagram == nullptr);
}

TEST_CASE("every enumeration of the options has bounds") {
  Grid f;
  pc_diagram* diagram = nullptr;
  for (const int wrong : {-1, 3, 1000}) {
    pc_options options;
    REQUIRE(pc_options_init(&options, sizeof options) == PC_OK);
    options.precision = static_cast<pc_precision>(wrong);
    CHECK(pc_diagram_create(shared_device(), f.domain.handle, &options, &diagram) == PC_INVALID_ARGUMENT);
    CHECK(message_has("options.precision"));
    REQUIRE(pc_options_init(&options, sizeof options) == PC_OK);
    options.neighbors = static_cast<pc_neighbors>(wrong);
    CHECK(pc_diagram_create(shared_device(), f.domain.handle, &options, &diagram) == PC_INVALID_ARGUMENT);
    CHECK(message_has("options.neighbors"));
    REQUIRE(pc_options_init(&options, sizeof options) == PC_OK);
    options.decisions = static_cast<pc_decisions>(wrong);
    CHECK(pc_diagram_create(shared_device(), f.domain.handle, &options, &diagram) == PC_INVALID_ARGUMENT);
    CHECK(message_has("options.decisions"));
  }
  CHECK(diagram == nullptr);
}

TEST_CASE("a group of devices computes what one computes, and outlives the handles of its members") {
  const pc_device_info* info = nullptr;
  REQUIRE(pc_device_info_view(shared_device(), &info) == PC_OK);
  Device group;
  {
    Device first, second;
    REQUIRE(pc_device_create(info->selector, &first.handle) == PC_OK);
    REQUIRE(pc_device_create(info->selector, &second.handle) == PC_OK);
    const pc_device* members[] = {first.handle, second.handle, first.handle};
    CHECK(pc_device_group_create(members, 3, &group.handle) == PC_INVALID_ARGUMENT);  // one twice
    CHECK(pc_device_group_create(members, 0, &group.handle) == PC_INVALID_ARGUMENT);
    CHECK(pc_device_group_create(nullptr, 2, &group.handle) == PC_INVALID_ARGUMENT);
    members[1] = nullptr;
    CHECK(pc_device_group_create(members, 2, &group.handle) == PC_INVALID_ARGUMENT);
    members[1] = second.handle;
    REQUIRE(pc_device_group_create(members, 2, &group.handle) == PC_OK);
  }
  Owned<const pc_device_list, pc_device_list_destroy> list;
  REQUIRE(pc_device_members(group.handle, &list.handle) == PC_OK);
  CHECK(list->count == 2);
  CHECK(pc_device_members(nullptr, &list.handle) == PC_INVALID_ARGUMENT);
  const auto masses = [](const pc_device* device) {
    const double low[] = {0, 0}, high[] = {1, 1};
    std::vector<double> positions;
    for (int k = 0; k < 300; ++k) positions.insert(positions.end(), {k * 0.618 - int(k * 0.618), k / 300.});
    Domain domain;
    REQUIRE(pc_domain_box(low, high, 2, &domain.handle) == PC_OK);
    pc_options options;
    REQUIRE(pc_options_init(&options, sizeof options) == PC_OK);
    options.chunk_pairs = 20;
    Diagram diagram;
    REQUIRE(pc_diagram_create(device, domain.handle, &options, &diagram.handle) == PC_OK);
    REQUIRE(pc_diagram_set_seeds(diagram.handle, positions.data(), nullptr, 300) == PC_OK);
    std::vector<double> mass(300);
    REQUIRE(pc_diagram_measures(diagram.handle, mass.data(), nullptr, nullptr, nullptr) == PC_OK);
    return mass;
  };
  CHECK(masses(group.handle) == masses(shared_device()));
}

TEST_CASE("the devices of the machine are those of C++") {
  Owned<const pc_device_list, pc_device_list_destroy> list;
  REQUIRE(pc_device_list_create(&list.handle) == PC_OK);
  const auto devices = powercell::devices();
  REQUIRE(list->count == devices.size());
  for (std::size_t k = 0; k < devices.size(); ++k) {
    const pc_device_info& info = *list->devices[k];
    CHECK(info.name == devices[k].name);
    CHECK(info.platform_name == devices[k].platform_name);
    CHECK(info.vendor == devices[k].vendor);
    CHECK(info.driver_version == devices[k].driver_version);
    CHECK(info.selector == devices[k].selector());
    CHECK((info.fp64 != 0) == devices[k].fp64);
    CHECK(info.compute_units == devices[k].compute_units);
    CHECK(info.memory_bytes == devices[k].memory_bytes);
    CHECK(std::string(pc_device_kind_name(info.kind)) == powercell::name(devices[k].type));
  }
  CHECK(std::string(pc_device_kind_name(static_cast<pc_device_kind>(44))) == "unknown");
  CHECK(pc_device_list_create(nullptr) == PC_INVALID_ARGUMENT);

  const pc_device_info* info = nullptr;
  REQUIRE(pc_device_info_view(shared_device(), &info) == PC_OK);
  Owned<const pc_device_list, pc_device_list_destroy> single;
  REQUIRE(pc_device_members(shared_device(), &single.handle) == PC_OK);
  REQUIRE(single->count == 1);
  CHECK(std::string(single->devices[0]->selector) == info->selector);
  CHECK(std::string(info->name) == pc_device_name(shared_device()));
  CHECK(pc_device_info_view(nullptr, &info) == PC_INVALID_ARGUMENT);
  double seconds = -1, processor = -1;
  int running = -1;
  REQUIRE(pc_device_build_seconds(shared_device(), &seconds) == PC_OK);
  CHECK(seconds >= 0);
  CHECK(pc_device_build_seconds(nullptr, &seconds) == PC_INVALID_ARGUMENT);
  REQUIRE(pc_kernel_builds(&running, &seconds, &processor) == PC_OK);
  CHECK(running == 0);
  CHECK(seconds >= 0);
  CHECK(pc_kernel_builds(nullptr, nullptr, nullptr) == PC_OK);
  CHECK(pc_device_rates(nullptr, PC_FLOAT32, &seconds, &processor) == PC_INVALID_ARGUMENT);
  CHECK(pc_device_rates(shared_device(), static_cast<pc_precision>(9), &seconds, nullptr) ==
        PC_INVALID_ARGUMENT);
  double bytes = 0, operations = 0;
  REQUIRE(pc_device_rates(shared_device(), PC_FLOAT32, &bytes, &operations) == PC_OK);
  CHECK(bytes > 0);
  CHECK(operations > 0);
  double launch = 0, transfer = 0;
  CHECK(pc_device_latencies(nullptr, &launch, &transfer) == PC_INVALID_ARGUMENT);
  REQUIRE(pc_device_latencies(shared_device(), &launch, &transfer) == PC_OK);
  CHECK(launch > 0);
  CHECK(transfer > 0);
  CHECK(pc_device_latencies(shared_device(), nullptr, nullptr) == PC_OK);
  double there = 0, back = 0;
  CHECK(pc_device_transfers(nullptr, 4096, &there, &back) == PC_INVALID_ARGUMENT);
  CHECK(pc_device_transfers(shared_device(), 0, &there, &back) == PC_INVALID_ARGUMENT);
  REQUIRE(pc_device_transfers(shared_device(), 4096, &there, &back) == PC_OK);
  CHECK(there > 0);
  CHECK(back > 0);
}

TEST_CASE("a domain tells what it is") {
  Domain box;
  const int along_y[2] = {0, 1};
  REQUIRE(pc_domain_periodic_box(low, high, along_y, 2, &box.handle) == PC_OK);
  const pc_domain_info* info = nullptr;
  REQUIRE(pc_domain_info_view(box.handle, &info) == PC_OK);
  CHECK(info->kind == PC_POLYGON);
  CHECK(info->dimension == 2);
  CHECK(info->cell_dimension == 2);
  CHECK(info->is_periodic == 1);
  CHECK(info->is_solid == 0);
  CHECK(info->measure == 2);
  CHECK(info->high[0] == 2);
  CHECK(info->periods[0][0] == 0);
  CHECK(info->periods[1][1] == 1);
  const double outside[4] = {0.5, 1.25, 1.5, -0.25};
  double wrapped[4] = {};
  REQUIRE(pc_domain_wrap(box.handle, outside, 2, wrapped) == PC_OK);
  CHECK(wrapped[1] == doctest::Approx(0.25));
  CHECK(wrapped[3] == doctest::Approx(0.75));
  CHECK(wrapped[2] == 1.5);
  CHECK(pc_domain_wrap(box.handle, nullptr, 2, wrapped) == PC_INVALID_ARGUMENT);
  CHECK(pc_domain_wrap(box.handle, outside, 2, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_domain_info_view(nullptr, &info) == PC_INVALID_ARGUMENT);

  const int bounded[2] = {0, 0};
  pc_domain* none = nullptr;
  CHECK(pc_domain_periodic_box(low, high, bounded, 2, &none) != PC_OK);
  CHECK(pc_domain_periodic_box(nullptr, high, bounded, 2, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_domain_periodic_box(low, high, nullptr, 4, &none) == PC_INVALID_ARGUMENT);
  const double dependent[4] = {1, 1, 2, 2};
  CHECK(pc_domain_lattice(dependent, nullptr, 2, &none) == PC_INVALID_DOMAIN);
  CHECK(pc_domain_lattice(nullptr, nullptr, 2, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_domain_lattice(dependent, nullptr, 1, &none) == PC_INVALID_ARGUMENT);
  CHECK(none == nullptr);
}

TEST_CASE("a domain has the regions, the report and the random points of C++") {
  // Two triangles of a square, one of them twice, and a flat one.
  const std::vector<double> vertices = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0, 0};
  const std::vector<uint32_t> triangles = {0, 1, 2, 0, 2, 3, 2, 1, 0, 0, 4, 1};
  Domain surface;
  REQUIRE(pc_domain_surface(vertices.data(), 5, triangles.data(), 4, &surface.handle) == PC_OK);
  const pc_mesh_report* report = nullptr;
  REQUIRE(pc_domain_report_view(surface.handle, &report) == PC_OK);
  REQUIRE(report->flat_count == 1);
  CHECK(report->flat[0] == 3);
  REQUIRE(report->repeated_count == 1);
  CHECK(report->repeated[0] == 2);
  CHECK(report->repeated[1] == 0);
  CHECK(report->overlaps == 0);
  REQUIRE(report->note_count == 2);
  CHECK(std::string(report->notes[0]) != "");

  const pc_regions* regions = nullptr;
  REQUIRE(pc_domain_regions_view(surface.handle, &regions) == PC_OK);
  const powercell::Domain same = powercell::Domain::surface(vertices, triangles);
  const powercell::RegionsView expected = same.regions();
  REQUIRE(regions->count == 2);
  CHECK(regions->shape == PC_REGION_POLYGON);
  CHECK(regions->vertex_count * 3 == expected.vertices.size());
  CHECK(std::equal(expected.source.begin(), expected.source.end(), regions->source));
  CHECK(std::equal(expected.region_vertex.begin(), expected.region_vertex.end(), regions->region_vertex));
  CHECK(regions->boundary_count == 4);
  CHECK(regions->facet[0].index == expected.facet[0].index);

  std::vector<double> points(15);
  std::vector<uint32_t> region(5);
  REQUIRE(pc_domain_random_points(surface.handle, 5, 8, region.data(), points.data()) == PC_OK);
  const auto drawn = powercell::random_points(same, 5, 8);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(region[i] == drawn[i].region);
    CHECK(std::equal(drawn[i].point.begin(), drawn[i].point.end(), &points[3 * i]));
  }
  CHECK(pc_domain_random_points(surface.handle, 5, 8, nullptr, points.data()) == PC_OK);
  CHECK(pc_domain_random_points(surface.handle, 5, 8, nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_domain_random_points(nullptr, 5, 8, nullptr, points.data()) == PC_INVALID_ARGUMENT);
  CHECK(pc_domain_report_view(nullptr, &report) == PC_INVALID_ARGUMENT);
  CHECK(pc_domain_regions_view(surface.handle, nullptr) == PC_INVALID_ARGUMENT);
}

TEST_CASE("shapes are those of C++") {
  std::vector<double> disk(10);
  REQUIRE(pc_shape_disk(5, disk.data()) == PC_OK);
  CHECK(disk[0] == 1);
  CHECK(disk[9] == powercell::disk(5)[4][1]);
  CHECK(pc_shape_disk(2, disk.data()) == PC_INVALID_ARGUMENT);
  CHECK(pc_shape_disk(5, nullptr) == PC_INVALID_ARGUMENT);

  Owned<const pc_triangle_mesh, pc_triangle_mesh_destroy> sphere, torus;
  REQUIRE(pc_shape_sphere(2, &sphere.handle) == PC_OK);
  CHECK(sphere->vertex_count == 42);
  CHECK(sphere->triangle_count == 80);
  const powercell::TriangleMesh same = powercell::sphere(2);
  CHECK(std::equal(same.vertices.begin(), same.vertices.end(), sphere->vertices));
  REQUIRE(pc_shape_torus(4, &torus.handle) == PC_OK);
  CHECK(torus->triangle_count == 80);
  Owned<const pc_tetrahedral_mesh, pc_tetrahedral_mesh_destroy> ball;
  REQUIRE(pc_shape_ball(2, &ball.handle) == PC_OK);
  CHECK(ball->tetrahedron_count == 64);
  const pc_triangle_mesh* none = nullptr;
  CHECK(pc_shape_sphere(0, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_shape_torus(2, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_shape_sphere(2, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_shape_ball(2, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(none == nullptr);
}
