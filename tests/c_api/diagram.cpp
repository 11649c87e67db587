// The C interface: correct results, and errors as a status, never an exception or a crash.
#include <cmath>
#include <limits>
#include <numeric>
#include <powercell/powercell.hpp>

#include "tests/c_api/handles.hpp"

using namespace powercell::c_api_test;

TEST_CASE("every status has the name of its error code") {
  CHECK(std::string(pc_status_name(PC_OK)) == "ok");
  CHECK(std::string(pc_status_name(PC_OUT_OF_MEMORY)) == "out_of_memory");
  for (int code = 0; code <= static_cast<int>(powercell::ErrorCode::internal); ++code)
    CHECK(std::string(pc_status_name(static_cast<pc_status>(code + 1))) ==
          powercell::name(static_cast<powercell::ErrorCode>(code)));
  CHECK(std::string(pc_status_name(static_cast<pc_status>(999))) == "unknown");
  CHECK(std::string(pc_version()) == powercell::version());
}

TEST_CASE("measures of a grid are those of its rectangles, and each array is optional") {
  Grid f;
  size_t count = 0;
  REQUIRE(pc_diagram_size(f.diagram.handle, &count) == PC_OK);
  CHECK(count == 4);
  std::vector<double> mass(4), centroid(8), moment(4);
  std::vector<uint8_t> status(4, 99);
  REQUIRE(pc_diagram_measures(f.diagram.handle, mass.data(), centroid.data(), moment.data(), status.data()) ==
          PC_OK);
  for (int i = 0; i < 4; ++i) {
    CHECK(mass[i] == doctest::Approx(0.5).epsilon(1e-5));
    CHECK(status[i] == PC_SEED_OK);
    // of a 1 x 1/2 rectangle about its centre
    CHECK(moment[i] == doctest::Approx(0.5 * (1 + 0.25) / 12).epsilon(1e-5));
  }
  for (int k = 0; k < 8; ++k) CHECK(centroid[k] == doctest::Approx(f.positions[k]).epsilon(1e-5));
  CHECK(pc_diagram_measures(f.diagram.handle, nullptr, nullptr, nullptr, nullptr) == PC_OK);
}

TEST_CASE("adjacency is called for its length, then for its entries") {
  Grid f;
  size_t count = 0;
  REQUIRE(pc_diagram_adjacency(f.diagram.handle, nullptr, nullptr, nullptr, &count) == PC_OK);
  REQUIRE(count >= 8);
  std::vector<uint64_t> offset(5);
  std::vector<uint32_t> neighbor(count, 77);
  std::vector<double> wall(count);

  size_t room = count - 1;
  CHECK(pc_diagram_adjacency(f.diagram.handle, offset.data(), neighbor.data(), wall.data(), &room) ==
        PC_INVALID_ARGUMENT);
  CHECK(room == count);
  CHECK(neighbor[0] == 77);
  CHECK(std::string(pc_last_error()).find("too short") != std::string::npos);

  REQUIRE(pc_diagram_adjacency(f.diagram.handle, offset.data(), neighbor.data(), wall.data(), &count) ==
          PC_OK);
  CHECK(offset[0] == 0);
  CHECK(offset[4] == count);
  CHECK(std::accumulate(wall.begin(), wall.end(), 0.0) == doctest::Approx(2 * (2 + 1)).epsilon(1e-5));
  CHECK(pc_diagram_adjacency(f.diagram.handle, nullptr, nullptr, wall.data(), &count) == PC_INVALID_ARGUMENT);
}

TEST_CASE("new weights move the walls, and a heavy seed hides the others") {
  Grid f;
  const double heavy[4] = {100, 0, 0, 0};
  REQUIRE(pc_diagram_set_weights(f.diagram.handle, heavy, 4) == PC_OK);
  std::vector<double> mass(4);
  std::vector<uint8_t> status(4);
  REQUIRE(pc_diagram_measures(f.diagram.handle, mass.data(), nullptr, nullptr, status.data()) == PC_OK);
  CHECK(mass[0] == doctest::Approx(2).epsilon(1e-5));
  for (int i = 1; i < 4; ++i) CHECK(status[i] == PC_SEED_HIDDEN);
  CHECK(pc_diagram_set_weights(f.diagram.handle, heavy, 3) == PC_INVALID_ARGUMENT);
}

TEST_CASE("the dual of three seeds is a triangle") {
  Domain domain;
  Diagram diagram;
  REQUIRE(pc_domain_box(low, high, 2, &domain.handle) == PC_OK);
  REQUIRE(pc_diagram_create(shared_device(), domain.handle, nullptr, &diagram.handle) == PC_OK);
  const double positions[6] = {0.5, 0.2, 1.5, 0.3, 1.0, 0.8};
  REQUIRE(pc_diagram_set_seeds(diagram.handle, positions, nullptr, 3) == PC_OK);
  int corners = 0;
  size_t count = 0;
  REQUIRE(pc_diagram_dual(diagram.handle, &corners, nullptr, &count) == PC_OK);
  REQUIRE(corners == 3);
  REQUIRE(count == 1);
  uint32_t simplex[3];
  REQUIRE(pc_diagram_dual(diagram.handle, &corners, simplex, &count) == PC_OK);
  CHECK(simplex[0] + simplex[1] + simplex[2] == 3);
  count = 0;
  CHECK(pc_diagram_dual(diagram.handle, &corners, simplex, &count) == PC_INVALID_ARGUMENT);
}

TEST_CASE("domains of every kind have the right measure") {
  const double corner[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const uint32_t tetrahedron[] = {0, 1, 2, 3};
  const uint32_t triangle[] = {0, 1, 2};
  Domain volume, surface, polygon;
  double measure = 0;
  REQUIRE(pc_domain_volume(corner, 4, tetrahedron, 1, &volume.handle) == PC_OK);
  REQUIRE(pc_domain_measure(volume.handle, &measure) == PC_OK);
  CHECK(measure == doctest::Approx(1.0 / 6));
  REQUIRE(pc_domain_surface(corner, 3, triangle, 1, &surface.handle) == PC_OK);
  REQUIRE(pc_domain_measure(surface.handle, &measure) == PC_OK);
  CHECK(measure == doctest::Approx(0.5));

  const uint32_t shell[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  Domain solid;
  REQUIRE(pc_domain_solid(corner, 4, shell, 4, &solid.handle) == PC_OK);
  REQUIRE(pc_domain_measure(solid.handle, &measure) == PC_OK);
  CHECK(measure == doctest::Approx(1.0 / 6));
  Domain open;
  CHECK(pc_domain_solid(corner, 4, shell, 3, &open.handle) == PC_INVALID_DOMAIN);

  // A square of side 4 with a square hole of side 1, and an island of side 1 beside it.
  const double points[] = {0, 0, 4, 0, 4, 4, 0, 4, 1, 1, 2, 1, 2, 2, 1, 2, 5, 0, 6, 0, 6, 1, 5, 1};
  const size_t ring_offset[] = {0, 4, 8, 12};
  const size_t part_offset[] = {0, 2, 3};
  REQUIRE(pc_domain_polygon(points, ring_offset, part_offset, 2, &polygon.handle) == PC_OK);
  REQUIRE(pc_domain_measure(polygon.handle, &measure) == PC_OK);
  CHECK(measure == doctest::Approx(16));
}

TEST_CASE("errors become a status and a message, and the handle stays usable") {
  Grid f;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double bad[4] = {0.5, 0.5, 1.5, nan};
  CHECK(pc_diagram_set_seeds(f.diagram.handle, bad, nullptr, 2) == PC_INVALID_SEED);
  CHECK(std::string(pc_last_error()).find('1') != std::string::npos);  // the index of the seed
  CHECK(pc_diagram_measures(f.diagram.handle, nullptr, nullptr, nullptr, nullptr) == PC_OK);

  pc_device* device = nullptr;
  CHECK(pc_device_create("no such device", &device) == PC_DEVICE_NOT_FOUND);
  CHECK(device == nullptr);
  pc_domain* domain = nullptr;
  CHECK(pc_domain_box(high, low, 2, &domain) == PC_INVALID_DOMAIN);
  CHECK(pc_domain_box(low, high, 4, &domain) == PC_INVALID_ARGUMENT);
  const uint32_t out_of_range[] = {0, 1, 7};
  const double corner[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  CHECK(pc_domain_surface(corner, 3, out_of_range, 1, &domain) == PC_INVALID_DOMAIN);
  CHECK(domain == nullptr);
  pc_options options;
  pc_options_init(&options, sizeof options);
  options.precision = static_cast<pc_precision>(17);
  pc_diagram* diagram = nullptr;
  CHECK(pc_diagram_create(shared_device(), f.domain.handle, &options, &diagram) == PC_INVALID_ARGUMENT);
  CHECK(diagram == nullptr);
}

TEST_CASE("NULL handles and results are refused") {
  Grid f;
  size_t count = 0;
  CHECK(pc_device_create("", nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_domain_box(low, high, 2, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_domain_box(nullptr, high, 2, &f.domain.handle) == PC_INVALID_ARGUMENT);
  CHECK(pc_domain_measure(nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_size(nullptr, &count) == PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_set_seeds(nullptr, low, nullptr, 1) == PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_set_seeds(f.diagram.handle, nullptr, nullptr, 1) == PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_measures(nullptr, nullptr, nullptr, nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_diagram_adjacency(f.diagram.handle, nullptr, nullptr, nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_device_name(nullptr) == nullptr);
  pc_device_destroy(nullptr);
  pc_domain_destroy(nullptr);
  pc_diagram_destroy(nullptr);
}

TEST_CASE("the progress callback can stop a computation") {
  Domain domain;
  Diagram diagram;
  pc_options options;
  pc_options_init(&options, sizeof options);
  int calls = 0;
  options.progress = [](double, void* user) { return ++*static_cast<int*>(user) > 0 ? 0 : 1; };
  options.progress_user = &calls;
  REQUIRE(pc_domain_box(low, high, 2, &domain.handle) == PC_OK);
  REQUIRE(pc_diagram_create(shared_device(), domain.handle, &options, &diagram.handle) == PC_OK);
  const double position[2] = {1, 0.5};
  REQUIRE(pc_diagram_set_seeds(diagram.handle, position, nullptr, 1) == PC_OK);
  CHECK(pc_diagram_measures(diagram.handle, nullptr, nullptr, nullptr, nullptr) == PC_INTERRUPTED);
  CHECK(calls > 0);
}
