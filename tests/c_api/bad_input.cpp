// What every function of the C interface refuses: NULL, numbers that are none, counts that do not fit.
#include <powercell_opencl.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/c_api/handles.hpp"

using namespace powercell::c_api_test;

namespace {

constexpr size_t too_many = std::numeric_limits<size_t>::max() / 3 + 2;  // times 3 it is a small number

/// Not a number among numbers.
const double with_nan[12] = {0.1, 0.2, nan_value, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.3, 0.2, 0.7};
const uint32_t corners[4] = {0, 1, 2, 3};

}  // namespace

TEST_CASE("every function that destroys accepts NULL") {
  pc_density_destroy(nullptr);
  pc_density_integrals_destroy(nullptr);
  pc_device_destroy(nullptr);
  pc_device_diagram_destroy(nullptr);
  pc_device_list_destroy(nullptr);
  pc_diagram_destroy(nullptr);
  pc_distributed_cells_destroy(nullptr);
  pc_domain_destroy(nullptr);
  pc_joined_destroy(nullptr);
  pc_law_checks_destroy(nullptr);
  pc_local_diagram_destroy(nullptr);
  pc_mesh_quality_destroy(nullptr);
  pc_out_of_core_report_destroy(nullptr);
  pc_redistributed_seeds_destroy(nullptr);
  pc_remesh_result_destroy(nullptr);
  pc_repaired_mesh_destroy(nullptr);
  pc_results_destroy(nullptr);
  pc_sampling_result_destroy(nullptr);
  pc_spectrum_destroy(nullptr);
  pc_tetrahedral_mesh_destroy(nullptr);
  pc_transport_result_destroy(nullptr);
  pc_transport_solver_destroy(nullptr);
  pc_treemap_destroy(nullptr);
  pc_triangle_mesh_destroy(nullptr);
  pc_triangulation_destroy(nullptr);
  CHECK(pc_device_name(nullptr) == nullptr);
}

TEST_CASE("domains refuse NULL, numbers that are none, and counts that do not fit") {
  pc_domain* none = nullptr;
  const double square[8] = {0, 0, 1, 0, 1, 1, 0, 1};
  const size_t rings[3] = {0, 4, 2}, parts[3] = {0, 1, 1};
  CHECK(pc_domain_polygon(nullptr, rings, parts, 1, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_domain_polygon(square, nullptr, parts, 1, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_domain_polygon(square, rings, nullptr, 1, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_domain_polygon(square, rings, parts, 1, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_domain_polygon(square, rings, parts, 2, &none) == PC_INVALID_ARGUMENT);  // a part without a ring
  const size_t two_rings[2] = {0, 2};
  CHECK(pc_domain_polygon(square, rings, two_rings, 1, &none) == PC_INVALID_ARGUMENT);  // offsets fall
  CHECK(pc_domain_polygon(square, rings, parts, 0, &none) == PC_INVALID_DOMAIN);
  CHECK(pc_domain_polygon(with_nan, rings, parts, 1, &none) == PC_INVALID_DOMAIN);

  const auto refused = [&](auto function, size_t elements) {
    CHECK(function(nullptr, size_t{4}, corners, elements, &none) == PC_INVALID_ARGUMENT);
    CHECK(function(with_nan, size_t{4}, nullptr, elements, &none) == PC_INVALID_ARGUMENT);
    CHECK(function(with_nan, size_t{4}, corners, elements, nullptr) == PC_INVALID_ARGUMENT);
    CHECK(function(with_nan, too_many, corners, elements, &none) == PC_INVALID_ARGUMENT);
    CHECK(function(with_nan, size_t{4}, corners, too_many, &none) == PC_INVALID_ARGUMENT);
    CHECK(function(with_nan, size_t{4}, corners, elements, &none) == PC_INVALID_DOMAIN);
    CHECK(function(with_nan, size_t{0}, corners, size_t{0}, &none) == PC_INVALID_DOMAIN);
  };
  refused(&pc_domain_surface, 1);
  refused(&pc_domain_solid, 1);
  refused(&pc_domain_volume, 1);

  const double from[2] = {0, nan_value}, origin[2] = {nan_value, 0}, basis[4] = {1, 0, 0, nan_value};
  CHECK(pc_domain_box(from, high, 2, &none) == PC_INVALID_DOMAIN);
  CHECK(pc_domain_box(low, nullptr, 2, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_domain_periodic_box(from, high, nullptr, 2, &none) == PC_INVALID_DOMAIN);
  CHECK(pc_domain_lattice(basis, nullptr, 2, &none) == PC_INVALID_DOMAIN);
  CHECK(pc_domain_lattice(square, origin, 2, &none) == PC_INVALID_DOMAIN);
  CHECK(none == nullptr);
}

TEST_CASE("positions that are no numbers are refused wherever they are taken") {
  Grid f;
  Domain periodic;
  REQUIRE(pc_domain_periodic_box(low, high, nullptr, 2, &periodic.handle) == PC_OK);
  double numbers[12] = {};
  CHECK(pc_domain_wrap(periodic.handle, with_nan, 2, numbers) == PC_INVALID_SEED);
  CHECK(pc_domain_wrap(periodic.handle, with_nan, std::numeric_limits<size_t>::max(), numbers) ==
        PC_INVALID_ARGUMENT);
  CHECK(pc_measure(shared_device(), f.domain.handle, with_nan, nullptr, 6, nullptr, numbers, nullptr, nullptr,
                   nullptr) == PC_INVALID_SEED);
  CHECK(pc_diagram_set_seeds(f.diagram.handle, with_nan, nullptr, 6) == PC_INVALID_SEED);
  CHECK(pc_diagram_set_weights(f.diagram.handle, with_nan, 4) == PC_INVALID_SEED);
  // Other seeds than those of the diagram are a law that does not hold.
  Owned<const pc_law_checks, pc_law_checks_destroy> broken;
  REQUIRE(pc_diagram_verify(f.diagram.handle, with_nan, nullptr, 4, nullptr, &broken.handle) == PC_OK);
  CHECK(broken->passed == 0);
  const pc_law_checks* checks = nullptr;
  CHECK(pc_diagram_verify(f.diagram.handle, f.positions.data(), nullptr, 3, nullptr, &checks) ==
        PC_INVALID_ARGUMENT);
  CHECK(checks == nullptr);
  const pc_triangulation* triangulation = nullptr;
  CHECK(pc_triangulation_create(shared_device(), 2, with_nan, nullptr, 6, nullptr, &triangulation) ==
        PC_INVALID_SEED);
  CHECK(pc_triangulation_create(nullptr, 2, f.positions.data(), nullptr, 4, nullptr, &triangulation) ==
        PC_INVALID_ARGUMENT);
  CHECK(triangulation == nullptr);

  const pc_sampling_result* samples = nullptr;
  CHECK(pc_sample_from(shared_device(), f.domain.handle, with_nan, 6, nullptr, &samples) == PC_INVALID_SEED);
  CHECK(samples == nullptr);
  CHECK(pc_spacing(shared_device(), f.domain.handle, with_nan, 6, 0, 1, nullptr, numbers, nullptr, nullptr) !=
        PC_OK);
  const pc_spectrum* spectrum = nullptr;
  CHECK(pc_spectrum_create(f.domain.handle, with_nan, 6, 3, 1, &spectrum) == PC_INVALID_SEED);
  CHECK(spectrum == nullptr);
  const pc_repaired_mesh* repaired = nullptr;
  CHECK(pc_repair(with_nan, 4, corners, 1, -1, &repaired) == PC_INVALID_DOMAIN);
  CHECK(repaired == nullptr);
  CHECK(pc_farthest_from(with_nan, 4, corners, 1, with_nan, 4, corners, 1, 10, numbers) == PC_INVALID_DOMAIN);
  const int64_t parent[1] = {PC_NO_PARENT};
  const pc_treemap* treemap = nullptr;
  CHECK(pc_treemap_create(parent, f.positions.data(), 1, with_nan, 4, nullptr, &treemap) ==
        PC_INVALID_DOMAIN);
  CHECK(treemap == nullptr);
}

TEST_CASE("numbers of images and tolerances that are none are refused") {
  pc_density* none = nullptr;
  const double pixels[2] = {1, nan_value}, from[2] = {nan_value, 0}, good[2] = {1, 2};
  CHECK(pc_density_image(pixels, 2, 1, low, high, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_density_image(good, 2, 1, from, high, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_density_image(good, too_many, 3, low, high, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_density_nodal(pixels, 2, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_density_formula("x", nan_value, &none) == PC_INVALID_ARGUMENT);
  CHECK(none == nullptr);
  pc_verify_options verify;
  CHECK(pc_verify_options_init(nullptr, sizeof verify) == PC_INVALID_ARGUMENT);
  CHECK(pc_verify_options_init(&verify, 8) == PC_INVALID_ARGUMENT);
}

TEST_CASE("a log's sink that throws is of no consequence, and its level must be one") {
  int lines = 0;
  const auto sink = [](pc_log_level, const char*, void* user) {
    ++*static_cast<int*>(user);
    throw std::runtime_error("the disk is full");
  };
  CHECK(pc_set_log(sink, static_cast<pc_log_level>(2), &lines) == PC_INVALID_ARGUMENT);
  REQUIRE(pc_set_log(sink, PC_LOG_DETAIL, &lines) == PC_OK);
  Grid f;
  CHECK(pc_diagram_measures(f.diagram.handle, nullptr, nullptr, nullptr, nullptr) == PC_OK);
  REQUIRE(pc_set_log(nullptr, PC_LOG_INFO, nullptr) == PC_OK);
  CHECK(lines > 0);
}
