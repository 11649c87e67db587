// Integrals of a density over the cells that only the host can decide, and densities that are refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <powercell/diagram.hpp>

#include "tests/device_diagram/repaired.hpp"
#include "tests/device_diagram/weighted.hpp"
#include "tests/support/domains.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

struct RepairedMasses {
  Output before, after;
  Seeds list;
};

RepairedMasses repaired_masses(Caller& caller, DeviceDiagram& diagram, const SeedArray& seeds,
                               std::span<const double> values) {
  const Reals memory(caller, diagram.precision(), values);
  const Job job(caller, diagram.precision(), seeds.view());
  const List list(caller, seeds.size());
  diagram.set_density(memory.handle());
  job.enqueue(diagram, {{}, list.handles()});
  RepairedMasses result{job.read(), {}, list.read()};
  CHECK(job.repair(diagram, {{}, list.handles()}) == result.list.size());
  result.after = job.read();
  diagram.set_density(nullptr);
  return result;
}

/// The listed cells are those of the host, the others are as they were. \return how many were listed
std::size_t check_repaired_masses(Caller& caller, DeviceDiagram& diagram, const SeedArray& given,
                                  std::span<const double> values) {
  const SeedArray seeds = rounded_seeds(given, diagram.precision());
  const std::vector<double> rounded_values = rounded(values, diagram.precision());
  const RepairedMasses found = repaired_masses(caller, diagram, seeds, rounded_values);
  const DensityIntegrals exact =
      host_integrals(caller, diagram.domain(), seeds.view(), rounded_values, diagram.precision());
  const double largest = *std::max_element(values.begin(), values.end());
  CHECK(found.after.count(DeviceSeedStatus::unfinished) == 0);
  CHECK(differences(found.after, exact, diagram.domain(), largest, tolerance(diagram.precision())) == 0);
  // Of the listed cells measures are the exact ones, to the rounding of two ways to sum.
  const double error = diagram.precision() == Precision::float64 ? 1e-13 : 1e-7;
  std::size_t changed = 0, inexact = 0;
  for (std::uint32_t i = 0; i < seeds.size(); ++i) {
    const bool listed = std::binary_search(found.list.begin(), found.list.end(), i);
    changed += !listed && !same_row(found.before, found.after, i);
    if (listed)
      inexact +=
          static_cast<int>(found.after.status[i]) != static_cast<int>(exact.status[i]) ||
          !(std::abs(found.after.mass[i] - exact.mass[i]) <= error * (exact.mass[i] + largest * 1e-3)) ||
          !(std::abs(found.after.second_moment[i] - exact.second_moment[i]) <=
            10 * error * exact.second_moment[i]);
  }
  CHECK(changed == 0);
  CHECK(inexact == 0);
  return found.list.size();
}

}  // namespace

TEST_CASE("repaired cells have the integrals over the exact cells") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  const Domain sphere = surface_of(icosphere(1)), cube = volume_of(cube_tetrahedra(4, 0, random));
  const std::vector<double> on_sphere = random_values(sphere, random), in_cube = random_values(cube, random);
  for (const Precision precision : precisions(caller)) {
    CAPTURE(static_cast<int>(precision));
    DeviceDiagram surface(caller.device(), sphere, in_precision(precision)),
        volume(caller.device(), cube, in_precision(precision));
    // Bisectors in facets and between regions, and cells that meet in points.
    for (const int side : {4, 5}) {
      const SeedArray lattice = grid(side, 3), around = grid(side, 3, {{-1, -1, -1}, {1, 1, 1}});
      CHECK(check_repaired_masses(caller, volume, lattice, in_cube) > 0);
      CHECK(check_repaired_masses(caller, surface, around, on_sphere) > 0);
    }
    for (const WeightRange weights : {WeightRange::W1, WeightRange::W2}) {
      check_repaired_masses(caller, volume, seeds_for(cube, Distribution::white, weights, 300, random),
                            in_cube);
      check_repaired_masses(caller, surface, seeds_for(sphere, Distribution::white, weights, 300, random),
                            on_sphere);
    }
    // Pairs beyond the room.
    volume.set_pair_capacity(700);
    CHECK(check_repaired_masses(caller, volume,
                                seeds_for(cube, Distribution::white, WeightRange::W0, 300, random),
                                in_cube) > 50);
  }
}

TEST_CASE("repaired cells of values that are no densities are NaN, and those without mass have no centroid") {
  Caller& caller = shared_caller();
  Random random(test_seed());
  const Domain cube = volume_of(cube_tetrahedra(4, 0, random));
  DeviceDiagram diagram(caller.device(), cube);
  const SeedArray lattice = grid(4, 3);  // all of it is listed
  std::vector<double> values = linear_values(cube, -0.5, {1, 0, 0});
  for (double& value : values) value = std::max(value, 0.0);
  values[0] = std::nan("");  // at the origin
  const RepairedMasses found = repaired_masses(caller, diagram, lattice, values);
  REQUIRE(found.list.size() == lattice.size());
  std::size_t unknown = 0, without = 0, others = 0;
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    CHECK(found.after.status[i] == DeviceSeedStatus::ok);
    const double mass = found.after.mass[i], second = found.after.second_moment[i],
                 centroid = found.after.centroid[3 * i];
    if (std::isnan(mass)) {
      ++unknown;
      CHECK(std::isnan(second));
      CHECK(std::isnan(centroid));
      CHECK(lattice.coordinate(i, 0) < 0.25);
    } else if (mass == 0) {
      ++without;
      CHECK(second == 0);
      CHECK(std::isnan(centroid));
      CHECK(lattice.coordinate(i, 0) < 0.5);
    } else {
      ++others;
      CHECK(lattice.coordinate(i, 0) > 0.5);
      CHECK(centroid > lattice.coordinate(i, 0));
    }
  }
  CHECK(unknown == 1);
  CHECK(without == 31);
  CHECK(others == 32);
}

TEST_CASE("densities that cannot be are refused, and the one before stays") {
  Caller& caller = shared_caller();
  const Caller stranger;
  Random random(test_seed());
  const Domain domain = surface_of(wavy_patch(6));
  DeviceDiagram diagram(caller.device(), domain);
  const std::vector<double> values = random_values(domain, random);
  const SeedArray seeds = seeds_for(domain, Distribution::white, WeightRange::W0, 50, random);
  const Output expected = run_with(caller, diagram, seeds.view(), values);
  const Reals good(caller, diagram.precision(), values),
      small(caller, diagram.precision(), std::span(values).subspan(1)),
      foreign(stranger, diagram.precision(), values);
  diagram.set_density(good.handle());
  const auto error_of = [](const std::function<void()>& call) {
    try {
      call();
    } catch (const Error& error) {
      return std::pair(error.code(), std::string(error.what()));
    }
    return std::pair(ErrorCode::internal, std::string("no error"));
  };
  const auto too_small = error_of([&] { diagram.set_density(small.handle()); }),
             of_others = error_of([&] { diagram.set_density(foreign.handle()); });
  CHECK(too_small.first == ErrorCode::invalid_argument);
  CHECK(too_small.second.find("the values of the density has ") != std::string::npos);
  CHECK(of_others.first == ErrorCode::invalid_argument);
  CHECK(of_others.second.find("another context") != std::string::npos);
  const Output found = run(caller, diagram, seeds.view());
  for (std::size_t i = 0; i < seeds.size(); ++i) CHECK(same_row(found, expected, i));

  // The diagram of no seeds.
  const Job none(caller, diagram.precision(), SeedArray{3, {}, {}}.view());
  none.enqueue(diagram);
  CHECK(none.read().mass.empty());

  const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
  for (const Domain& other :
       {Domain::polygon(letter_u()), unit_box(2), unit_box(3), Domain::periodic_box(low, high)}) {
    DeviceDiagram without(caller.device(), other);
    const auto refused = error_of([&] { without.set_density(good.handle()); });
    CHECK(refused.first == ErrorCode::unsupported);
    const auto by_host = error_of([&] { Density::nodal(values).total(other); });
    CHECK(refused == by_host);
    without.set_density(nullptr);
  }
}
