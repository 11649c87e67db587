// The applications of the C interface give what C++ gives, and refuse what is wrong.
#include <cmath>
#include <limits>
#include <numeric>
#include <powercell/powercell.hpp>
#include <stdexcept>

#include "tests/c_api/handles.hpp"
#include "tests/support/setups.hpp"

using namespace powercell::c_api_test;

namespace {

using Density = Owned<pc_density, pc_density_destroy>;
using Integrals = Owned<const pc_density_integrals, pc_density_integrals_destroy>;
using Transport = Owned<const pc_transport_result, pc_transport_result_destroy>;
using Solver = Owned<pc_transport_solver, pc_transport_solver_destroy>;
using Samples = Owned<const pc_sampling_result, pc_sampling_result_destroy>;
using Spectrum = Owned<const pc_spectrum, pc_spectrum_destroy>;

int tilted(const double* point, double* value, void*) {
  *value = 1 + point[0];
  return 1;
}

template <class T>
std::vector<T> copied(const T* values, std::size_t count) {
  return {values, values + count};
}

}  // namespace

TEST_CASE("densities have the integral of C++") {
  Grid f;
  Density constant, formula, function, image, nodal;
  double total = 0;
  int yes = -1;
  REQUIRE(pc_density_constant(3, &constant.handle) == PC_OK);
  REQUIRE(pc_density_total(constant.handle, f.domain.handle, 0, &total) == PC_OK);
  CHECK(total == doctest::Approx(6));
  REQUIRE(pc_density_is_constant(constant.handle, &yes) == PC_OK);
  CHECK(yes == 1);
  REQUIRE(pc_density_formula("1 + x", 0, &formula.handle) == PC_OK);
  REQUIRE(pc_density_total(formula.handle, f.domain.handle, 1, &total) == PC_OK);
  CHECK(total == doctest::Approx(4));
  REQUIRE(pc_density_is_exact(formula.handle, &yes) == PC_OK);
  CHECK(yes == 0);
  REQUIRE(pc_density_function(&tilted, nullptr, 1e-6, &function.handle) == PC_OK);
  REQUIRE(pc_density_total(function.handle, f.domain.handle, 0, &total) == PC_OK);
  CHECK(total == doctest::Approx(4));

  const double pixels[2] = {1, 3};  // the left and the right half
  REQUIRE(pc_density_image(pixels, 2, 1, low, high, &image.handle) == PC_OK);
  REQUIRE(pc_density_total(image.handle, f.domain.handle, 0, &total) == PC_OK);
  CHECK(total == doctest::Approx(4));

  const double corner[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const uint32_t triangle[] = {0, 1, 2};
  const double values[3] = {0, 3, 3};
  Domain surface;
  REQUIRE(pc_domain_surface(corner, 3, triangle, 1, &surface.handle) == PC_OK);
  REQUIRE(pc_density_nodal(values, 3, &nodal.handle) == PC_OK);
  REQUIRE(pc_density_total(nodal.handle, surface.handle, 0, &total) == PC_OK);
  CHECK(total == doctest::Approx(1));
}

TEST_CASE("wrong densities are refused") {
  Grid f;
  Density density;
  double total = 0;
  const double negative[2] = {1, -1};
  CHECK(pc_density_constant(0, &density.handle) == PC_INVALID_ARGUMENT);
  CHECK(pc_density_constant(nan_value, &density.handle) == PC_INVALID_ARGUMENT);
  CHECK(pc_density_constant(1, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_density_formula("1 +", 0, &density.handle) == PC_INVALID_ARGUMENT);
  CHECK(pc_density_formula("1", 2, &density.handle) == PC_INVALID_ARGUMENT);
  CHECK(pc_density_formula(nullptr, 0, &density.handle) == PC_INVALID_ARGUMENT);
  CHECK(pc_density_function(nullptr, nullptr, 0, &density.handle) == PC_INVALID_ARGUMENT);
  CHECK(pc_density_image(negative, 2, 1, low, high, &density.handle) == PC_INVALID_ARGUMENT);
  CHECK(pc_density_image(negative, 0, 1, low, high, &density.handle) == PC_INVALID_ARGUMENT);
  CHECK(pc_density_image(nullptr, 2, 1, low, high, &density.handle) == PC_INVALID_ARGUMENT);
  CHECK(pc_density_image(negative, 2, 1, nullptr, high, &density.handle) == PC_INVALID_ARGUMENT);
  CHECK(pc_density_nodal(negative, 2, &density.handle) == PC_INVALID_ARGUMENT);
  CHECK(pc_density_nodal(nullptr, 2, &density.handle) == PC_INVALID_ARGUMENT);
  CHECK(density.handle == nullptr);
  CHECK(pc_density_total(nullptr, f.domain.handle, 0, &total) == PC_INVALID_ARGUMENT);
  CHECK(pc_density_is_constant(nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_density_is_exact(nullptr, nullptr) == PC_INVALID_ARGUMENT);
}

TEST_CASE("a density's function that stops, throws or is no number becomes a status") {
  Grid f;
  Density stops, throws, wrong;
  double total = 0;
  REQUIRE(pc_density_function([](const double*, double*, void*) { return 0; }, nullptr, 0, &stops.handle) ==
          PC_OK);
  CHECK(pc_density_total(stops.handle, f.domain.handle, 0, &total) == PC_INTERRUPTED);
  CHECK(message_has("asked to stop"));
  const auto throwing = [](const double*, double*, void*) -> int {
    throw std::runtime_error("no such place");
  };
  REQUIRE(pc_density_function(throwing, nullptr, 0, &throws.handle) == PC_OK);
  CHECK(pc_density_total(throws.handle, f.domain.handle, 0, &total) == PC_INTERRUPTED);
  CHECK(message_has("no such place"));
  REQUIRE(pc_density_function(
              [](const double*, double* value, void*) {
                *value = nan_value;
                return 1;
              },
              nullptr, 0, &wrong.handle) == PC_OK);
  CHECK(pc_density_total(wrong.handle, f.domain.handle, 0, &total) == PC_INVALID_ARGUMENT);
  Integrals integrals;
  CHECK(pc_integrate(f.diagram.handle, throws.handle, nullptr, &integrals.handle) == PC_INTERRUPTED);
  CHECK(integrals.handle == nullptr);
}

TEST_CASE("integrals of a density over cells and walls are those of C++") {
  Grid f;
  Density density;
  Integrals integrals;
  pc_integration_options options;
  REQUIRE(pc_integration_options_init(&options, sizeof options) == PC_OK);
  options.walls = 1;
  REQUIRE(pc_density_formula("1 + x", 0, &density.handle) == PC_OK);
  REQUIRE(pc_integrate(f.diagram.handle, density.handle, &options, &integrals.handle) == PC_OK);
  powercell::Diagram diagram(powercell::test::test_device(),
                             powercell::Domain::box(std::span(low, 2), std::span(high, 2)));
  diagram.set_seeds({2, f.positions, {}});
  const powercell::DensityIntegrals same =
      powercell::integrate(diagram, powercell::Density::formula("1 + x"), true);
  REQUIRE(integrals->count == 4);
  CHECK(copied(integrals->mass, 4) == same.mass);
  CHECK(copied(integrals->centroid, 8) == same.centroid);
  CHECK(copied(integrals->second_moment, 4) == same.second_moment);
  CHECK(integrals->status[0] == PC_SEED_OK);
  CHECK(integrals->domain_mass == same.domain_mass);
  CHECK(integrals->total == same.total());
  CHECK(integrals->relative_error == same.relative_error());
  CHECK(copied(integrals->mass_error, 4) == same.mass_error);
  REQUIRE(integrals->walls != nullptr);
  CHECK(copied(integrals->walls->wall, integrals->walls->entry_count) == same.walls.wall);

  std::size_t asked = 0;
  options.walls_if = [](const double*, size_t n, void* user) {
    *static_cast<std::size_t*>(user) = n;
    return 0;
  };
  options.walls_if_user = &asked;
  Integrals skipped;
  REQUIRE(pc_integrate(f.diagram.handle, density.handle, &options, &skipped.handle) == PC_OK);
  CHECK(asked == 4);
  CHECK(skipped->walls == nullptr);
  pc_density_integrals* none = nullptr;
  CHECK(pc_integrate(nullptr, density.handle, nullptr, const_cast<const pc_density_integrals**>(&none)) ==
        PC_INVALID_ARGUMENT);
  CHECK(pc_integrate(f.diagram.handle, nullptr, nullptr, const_cast<const pc_density_integrals**>(&none)) ==
        PC_INVALID_ARGUMENT);
  CHECK(pc_integrate(f.diagram.handle, density.handle, nullptr, nullptr) == PC_INVALID_ARGUMENT);
  options.tolerance = 3;
  CHECK(pc_integrate(f.diagram.handle, density.handle, &options,
                     const_cast<const pc_density_integrals**>(&none)) == PC_INVALID_ARGUMENT);
  options.struct_size += 8;
  CHECK(pc_integrate(f.diagram.handle, density.handle, &options,
                     const_cast<const pc_density_integrals**>(&none)) == PC_INVALID_ARGUMENT);
  CHECK(pc_integration_options_init(&options, 1) == PC_INVALID_ARGUMENT);
  CHECK(none == nullptr);
}

TEST_CASE("transport meets the masses, once and by a solver") {
  Grid f;
  const double masses[4] = {1, 2, 3, 4};
  pc_transport_options options;
  REQUIRE(pc_transport_options_init(&options, sizeof options) == PC_OK);
  CHECK(options.max_steps == 500);
  options.rescale = 1;
  int steps = 0;
  options.progress = [](const pc_transport_step* step, void* user) {
    ++*static_cast<int*>(user);
    return step->step >= 0 ? 1 : 0;
  };
  options.progress_user = &steps;
  Transport once;
  REQUIRE(pc_transport(shared_device(), f.domain.handle, f.positions.data(), nullptr, 4, masses, &options,
                       &once.handle) == PC_OK);
  CHECK(once->converged == 1);
  REQUIRE(once->count == 4);
  for (int i = 0; i < 4; ++i) CHECK(once->mass[i] == doctest::Approx(0.2 * masses[i]).epsilon(1e-5));
  CHECK(once->total_mass == doctest::Approx(2));
  CHECK(once->dimension == 2);
  CHECK(once->merged == 0);
  CHECK(once->merged_with[3] == 3);
  CHECK(once->dual == doctest::Approx(once->primal));
  REQUIRE(once->step_count > 0);
  CHECK(steps > 0);
  CHECK(once->steps[once->step_count - 1]->error < 1e-5);
  CHECK(std::string(pc_transport_phase_name(once->steps[0]->phase)) == "start");
  CHECK(std::string(pc_linear_solver_name(PC_LINEAR_MULTILEVEL)) == "multilevel");
  CHECK(std::string(pc_linear_solver_name(static_cast<pc_linear_solver>(-3))) == "unknown");
  CHECK(std::string(pc_transport_phase_name(static_cast<pc_transport_phase>(4))) == "unknown");

  Solver solver;
  Transport first, kept;
  pc_diagram* diagram = nullptr;
  REQUIRE(pc_transport_solver_create(shared_device(), f.domain.handle, &options, &solver.handle) == PC_OK);
  REQUIRE(pc_transport_solver_set_seeds(solver.handle, f.positions.data(), nullptr, 4) == PC_OK);
  CHECK(pc_transport_solver_diagram(solver.handle, &diagram) == PC_INVALID_ARGUMENT);
  REQUIRE(pc_transport_solver_set_masses(solver.handle, masses, 4) == PC_OK);
  REQUIRE(pc_transport_solver_solve(solver.handle, &first.handle) == PC_OK);
  for (int i = 0; i < 4; ++i) CHECK(first->weights[i] == once->weights[i]);
  REQUIRE(pc_transport_solver_result(solver.handle, &kept.handle) == PC_OK);
  CHECK(kept->error == first->error);
  REQUIRE(pc_transport_solver_diagram(solver.handle, &diagram) == PC_OK);
  std::vector<double> mass(4);
  REQUIRE(pc_diagram_measures(diagram, mass.data(), nullptr, nullptr, nullptr) == PC_OK);
  CHECK(mass[3] == doctest::Approx(0.8).epsilon(1e-5));
  pc_diagram_destroy(diagram);  // of the solver: stays
  REQUIRE(pc_diagram_measures(diagram, mass.data(), nullptr, nullptr, nullptr) == PC_OK);

  std::vector<double> moved = f.positions;
  moved[0] += 0.05;
  REQUIRE(pc_transport_solver_move_seeds(solver.handle, moved.data(), 4) == PC_OK);
  CHECK(pc_transport_solver_diagram(solver.handle, &diagram) == PC_INVALID_ARGUMENT);
  REQUIRE(pc_transport_solver_set_tolerance(solver.handle, 1e-3) == PC_OK);
  REQUIRE(pc_transport_solver_set_max_steps(solver.handle, 50) == PC_OK);
  const double zero[4] = {};
  REQUIRE(pc_transport_solver_set_weights(solver.handle, zero, 4) == PC_OK);
  REQUIRE(pc_transport_solver_solve(solver.handle, nullptr) == PC_OK);
  CHECK(pc_transport_solver_set_masses(solver.handle, nullptr, 0) == PC_OK);
}

TEST_CASE("wrong transports are refused, and stop when asked to") {
  Grid f;
  pc_transport_options options;
  REQUIRE(pc_transport_options_init(&options, sizeof options) == PC_OK);
  Transport result;
  const auto run = [&](const double* masses) {
    return pc_transport(shared_device(), f.domain.handle, f.positions.data(), nullptr, 4, masses, &options,
                        &result.handle);
  };
  const double unequal[4] = {1, 1, 1, 1}, negative[4] = {0.5, 0.5, 2, -1}, bad[4] = {nan_value, 1, 1, 1};
  CHECK(run(unequal) == PC_INVALID_ARGUMENT);  // the domain has 2
  CHECK(run(negative) == PC_INVALID_ARGUMENT);
  CHECK(run(bad) == PC_INVALID_ARGUMENT);
  options.linear = static_cast<pc_linear_solver>(17);
  CHECK(run(nullptr) == PC_INVALID_ARGUMENT);
  CHECK(message_has("options.linear"));
  REQUIRE(pc_transport_options_init(&options, sizeof options) == PC_OK);
  options.tolerance = nan_value;
  CHECK(run(nullptr) == PC_INVALID_ARGUMENT);
  REQUIRE(pc_transport_options_init(&options, sizeof options) == PC_OK);
  options.progress = [](const pc_transport_step*, void*) { return 0; };
  CHECK(run(nullptr) == PC_INTERRUPTED);
  options.progress = [](const pc_transport_step*, void*) -> int { throw std::runtime_error("enough"); };
  CHECK(run(nullptr) == PC_INTERRUPTED);
  CHECK(message_has("enough"));
  options.struct_size = 8;
  CHECK(run(nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_transport_options_init(&options, 8) == PC_INVALID_ARGUMENT);
  CHECK(pc_transport(nullptr, f.domain.handle, f.positions.data(), nullptr, 4, nullptr, nullptr,
                     &result.handle) == PC_INVALID_ARGUMENT);
  CHECK(pc_transport(shared_device(), nullptr, f.positions.data(), nullptr, 4, nullptr, nullptr,
                     &result.handle) == PC_INVALID_ARGUMENT);
  CHECK(pc_transport(shared_device(), f.domain.handle, nullptr, nullptr, 4, nullptr, nullptr,
                     &result.handle) == PC_INVALID_ARGUMENT);
  CHECK(pc_transport(shared_device(), f.domain.handle, f.positions.data(), nullptr, 4, nullptr, nullptr,
                     nullptr) == PC_INVALID_ARGUMENT);
  CHECK(result.handle == nullptr);

  Solver solver;
  CHECK(pc_transport_solver_create(shared_device(), f.domain.handle, nullptr, nullptr) ==
        PC_INVALID_ARGUMENT);
  REQUIRE(pc_transport_solver_create(shared_device(), f.domain.handle, nullptr, &solver.handle) == PC_OK);
  CHECK(pc_transport_solver_solve(solver.handle, nullptr) == PC_INVALID_ARGUMENT);  // no seeds
  CHECK(pc_transport_solver_set_seeds(solver.handle, nullptr, nullptr, 4) == PC_INVALID_ARGUMENT);
  CHECK(pc_transport_solver_set_seeds(solver.handle, bad, nullptr, 2) == PC_INVALID_SEED);
  CHECK(pc_transport_solver_move_seeds(solver.handle, f.positions.data(), 4) == PC_INVALID_ARGUMENT);
  REQUIRE(pc_transport_solver_set_seeds(solver.handle, f.positions.data(), nullptr, 4) == PC_OK);
  CHECK(pc_transport_solver_set_weights(solver.handle, unequal, 3) == PC_INVALID_ARGUMENT);
  CHECK(pc_transport_solver_set_weights(solver.handle, bad, 4) == PC_INVALID_SEED);
  CHECK(pc_transport_solver_set_masses(solver.handle, unequal, 3) == PC_INVALID_ARGUMENT);
  CHECK(pc_transport_solver_set_tolerance(solver.handle, 1) == PC_INVALID_ARGUMENT);
  CHECK(pc_transport_solver_set_max_steps(solver.handle, -1) == PC_INVALID_ARGUMENT);
  CHECK(pc_transport_solver_set_tolerance(nullptr, 0) == PC_INVALID_ARGUMENT);
  CHECK(pc_transport_solver_result(nullptr, &result.handle) == PC_INVALID_ARGUMENT);
  CHECK(pc_transport_solver_diagram(nullptr, nullptr) == PC_INVALID_ARGUMENT);
  pc_transport_solver_destroy(nullptr);
}

TEST_CASE("samples have equal masses, and the same bits as in C++") {
  Grid f;
  pc_sampling_options options;
  REQUIRE(pc_sampling_options_init(&options, sizeof options) == PC_OK);
  options.iterations = 3;
  int steps = 0;
  options.progress = [](const pc_sampling_step* step, void* user) {
    *static_cast<int*>(user) += step->iteration >= 0;
    return 1;
  };
  options.progress_user = &steps;
  Samples samples, again;
  REQUIRE(pc_sample(shared_device(), f.domain.handle, 60, &options, &samples.handle) == PC_OK);
  powercell::SamplingOptions same;
  same.iterations = 3;
  const powercell::SamplingResult expected =
      powercell::sample(powercell::test::test_device(),
                        powercell::Domain::box(std::span(low, 2), std::span(high, 2)), 60, same);
  REQUIRE(samples->count == 60);
  CHECK(copied(samples->positions, 120) == expected.positions);
  CHECK(copied(samples->weights, 60) == expected.weights);
  CHECK(samples->energy == expected.energy);
  CHECK(samples->capacity_error < 1e-5);
  CHECK(samples->layer_count == 0);
  CHECK(samples->apart_cells == 0);
  REQUIRE(samples->step_count == expected.steps.size());
  CHECK(static_cast<std::size_t>(steps) == samples->step_count);
  REQUIRE(pc_sample_from(shared_device(), f.domain.handle, samples->positions, 60, &options, &again.handle) ==
          PC_OK);
  CHECK(again->energy < samples->energy);

  const pc_sampling_result* none = nullptr;
  const auto refused = [&] {
    return pc_sample(shared_device(), f.domain.handle, 10, &options, &none) == PC_INVALID_ARGUMENT;
  };
  options.mode = static_cast<pc_sampling_mode>(2);
  CHECK(refused());
  REQUIRE(pc_sampling_options_init(&options, sizeof options) == PC_OK);
  options.descent = static_cast<pc_sampling_descent>(-1);
  CHECK(refused());
  REQUIRE(pc_sampling_options_init(&options, sizeof options) == PC_OK);
  options.hexatic = nan_value;
  CHECK(refused());
  options.struct_size = 4;
  CHECK(refused());
  CHECK(pc_sampling_options_init(nullptr, sizeof options) == PC_INVALID_ARGUMENT);
  CHECK(pc_sample(shared_device(), f.domain.handle, 0, nullptr, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_sample(nullptr, f.domain.handle, 4, nullptr, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_sample(shared_device(), f.domain.handle, 4, nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_sample_from(shared_device(), f.domain.handle, nullptr, 4, nullptr, &none) == PC_INVALID_ARGUMENT);
  REQUIRE(pc_sampling_options_init(&options, sizeof options) == PC_OK);
  options.progress = [](const pc_sampling_step*, void*) { return 0; };
  CHECK(pc_sample(shared_device(), f.domain.handle, 10, &options, &none) == PC_INTERRUPTED);
  CHECK(none == nullptr);
}

TEST_CASE("random points, their spacing and their spectra are those of C++") {
  Grid f;
  Density density;
  REQUIRE(pc_density_constant(1, &density.handle) == PC_OK);
  std::vector<double> points(80);
  REQUIRE(pc_random_points(f.domain.handle, density.handle, 40, 7, points.data()) == PC_OK);
  const powercell::Domain box = powercell::Domain::box(std::span(low, 2), std::span(high, 2));
  CHECK(points == powercell::random_points(box, powercell::Density::constant(1), 40, 7));
  CHECK(pc_random_points(f.domain.handle, density.handle, 40, 7, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_random_points(f.domain.handle, nullptr, 40, 7, points.data()) == PC_INVALID_ARGUMENT);

  double least = -1, mean = -1, hexatic = -1;
  REQUIRE(pc_spacing(shared_device(), f.domain.handle, points.data(), 40, 0, 1, nullptr, &least, &mean,
                     &hexatic) == PC_OK);
  const powercell::Spacing expected = powercell::spacing(powercell::test::test_device(), box, points);
  CHECK(least == expected.least);
  CHECK(mean == expected.mean);
  CHECK(hexatic == expected.hexatic);
  CHECK(pc_spacing(shared_device(), f.domain.handle, points.data(), 1, 0, 1, nullptr, &least, &mean,
                   &hexatic) == PC_INVALID_ARGUMENT);
  CHECK(pc_spacing(nullptr, f.domain.handle, points.data(), 40, 0, 1, nullptr, &least, &mean, &hexatic) ==
        PC_INVALID_ARGUMENT);

  Spectrum one, other, both;
  REQUIRE(pc_spectrum_create(f.domain.handle, points.data(), 40, 5, 1, &one.handle) == PC_OK);
  const powercell::Spectrum spectrum = powercell::spectrum(box, points, 5, 1);
  CHECK(one->highest == 5);
  CHECK(one->points == 40);
  CHECK(copied(one->power, 121) == spectrum.power);
  CHECK(copied(one->radial_mean, 5) == spectrum.radial().mean);
  CHECK(copied(one->radial_anisotropy, 5) == spectrum.radial().anisotropy);
  REQUIRE(pc_random_points(f.domain.handle, density.handle, 40, 8, points.data()) == PC_OK);
  REQUIRE(pc_spectrum_create(f.domain.handle, points.data(), 40, 5, 1, &other.handle) == PC_OK);
  const pc_spectrum* const spectra[2] = {one.handle, other.handle};
  REQUIRE(pc_spectrum_mean(spectra, 2, &both.handle) == PC_OK);
  CHECK(both->runs == 2);
  CHECK(both->power[0] == doctest::Approx((one->power[0] + other->power[0]) / 2));
  double power = -1;
  REQUIRE(pc_spectrum_low_frequency(one.handle, 0.5, &power) == PC_OK);
  CHECK(power == spectrum.low_frequency(0.5));

  const pc_spectrum* none = nullptr;
  const pc_spectrum* const missing[1] = {nullptr};
  CHECK(pc_spectrum_create(f.domain.handle, nullptr, 40, 5, 1, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_spectrum_create(f.domain.handle, points.data(), 0, 5, 1, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_spectrum_create(f.domain.handle, points.data(), 40, -1, 1, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_spectrum_mean(spectra, 0, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_spectrum_mean(missing, 1, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_spectrum_low_frequency(nullptr, 0.5, &power) == PC_INVALID_ARGUMENT);
  CHECK(none == nullptr);
}
