#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <powercell/diagram.hpp>
#include <powercell/shapes.hpp>

#include "tests/device_diagram/caller.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/generators.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

template <class Call>
std::optional<Error> error_of(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error;
  }
  return std::nullopt;
}

cl_int execution_status(cl_event event) {
  cl_int status = CL_COMPLETE;
  REQUIRE(clGetEventInfo(event, CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof status, &status, nullptr) ==
          CL_SUCCESS);
  return status;
}

bool same(const Output& a, const Output& b) {
  const auto equal = [](const std::vector<double>& x, const std::vector<double>& y) {
    if (x.size() != y.size()) return false;
    for (std::size_t k = 0; k < x.size(); ++k)
      if (!(x[k] == y[k] || (std::isnan(x[k]) && std::isnan(y[k])))) return false;
    return true;
  };
  return equal(a.mass, b.mass) && equal(a.centroid, b.centroid) && equal(a.second_moment, b.second_moment) &&
         a.status == b.status;
}

/// Enqueues with an event that only this thread completes: a call that waited would not return.
void check_gate(Caller& caller, const Domain& domain, std::uint32_t pair_capacity,
                std::uint32_t image_capacity = 0) {
  Random random(test_seed());
  const int d = domain.dimension();
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 2000, d, random);
  DeviceDiagram diagram(caller.device(), domain);
  diagram.set_pair_capacity(pair_capacity);
  diagram.set_image_capacity(image_capacity);
  cl_int status = CL_SUCCESS;
  cl_event gate = clCreateUserEvent(caller.context(), &status);
  REQUIRE(status == CL_SUCCESS);
  cl_event done = nullptr;
  const Job job(caller, diagram.precision(), seeds.view());
  job.enqueue(diagram, 1, &gate, &done);
  REQUIRE(done != nullptr);
  CHECK(execution_status(done) > CL_COMPLETE);
  // The next call grows and reuses the scratch memory of the first one, which has not started.
  const SeedArray others = random_seeds(Distribution::white, WeightRange::W0, 5000, d, random);
  const Job next(caller, diagram.precision(), others.view());
  next.enqueue(diagram);
  REQUIRE(clSetUserEventStatus(gate, CL_COMPLETE) == CL_SUCCESS);
  REQUIRE(clWaitForEvents(1, &done) == CL_SUCCESS);
  CHECK(execution_status(done) == CL_COMPLETE);
  clReleaseEvent(done);
  clReleaseEvent(gate);
  const Output first = job.read(), second = next.read();
  CHECK(first.count(DeviceSeedStatus::unfinished) == 0);
  CHECK(same(first, run(caller, diagram, seeds.view())));
  CHECK(same(second, run(caller, diagram, others.view())));
}

}  // namespace

TEST_CASE("a call returns before its wait list is complete, and its work runs after that") {
  for (const cl_command_queue_properties properties :
       {cl_command_queue_properties{0}, cl_command_queue_properties{CL_QUEUE_PROFILING_ENABLE}}) {
    Caller caller(properties);
    check_gate(caller, unit_box(2), 0);
    check_gate(caller, Domain::polygon(square_with_holes()), 60000);
    const double low[] = {0, 0}, high[] = {1, 1};
    check_gate(caller, Domain::periodic_box(low, high), 0, 20000);
  }
}

TEST_CASE("no seed, one seed and two seeds") {
  Caller& caller = shared_caller();
  for (const int dimension : {2, 3}) {
    DeviceDiagram diagram(caller.device(), unit_box(dimension));
    const double exact = diagram.precision() == Precision::float64 ? 1e-14 : 1e-6;
    SeedArray seeds{dimension, {}, {}};
    CHECK(run(caller, diagram, seeds.view()).mass.empty());
    cl_event done = nullptr;
    diagram.enqueue(nullptr, nullptr, 0, nullptr, nullptr, 0, nullptr, &done);
    REQUIRE(clWaitForEvents(1, &done) == CL_SUCCESS);
    clReleaseEvent(done);

    seeds.positions.assign(static_cast<std::size_t>(dimension), 0.25);
    seeds.weights = {-3};
    Output output = run(caller, diagram, seeds.view());
    CHECK(output.status[0] == DeviceSeedStatus::ok);
    CHECK(std::abs(output.mass[0] - 1) <= exact);
    CHECK(std::abs(output.centroid[0] - 0.5) <= exact);
    // About 1/4 along each axis: 1/12 + 1/16.
    CHECK(std::abs(output.second_moment[0] - dimension * (1.0 / 12 + 1.0 / 16)) <= 4 * exact);

    // Seeds at x = 1/4 and 3/4, the second one heavier by 1/4: the wall moves to x = 1/4.
    seeds.positions.insert(seeds.positions.end(), static_cast<std::size_t>(dimension), 0.25);
    seeds.coordinate(1, 0) = 0.75;
    seeds.weights = {0, 0.25};
    output = run(caller, diagram, seeds.view());
    CHECK(std::abs(output.mass[0] - 0.25) <= exact);
    CHECK(std::abs(output.mass[1] - 0.75) <= exact);
    CHECK(std::abs(output.centroid[static_cast<std::size_t>(dimension)] - 0.625) <= exact);
    // Without the weights the wall is in the middle.
    output = run(caller, diagram, seeds.view(), false);
    CHECK(std::abs(output.mass[0] - 0.5) <= exact);

    seeds.weights = {0, 10};
    output = run(caller, diagram, seeds.view());
    CHECK(output.status[0] == DeviceSeedStatus::hidden);
    CHECK(output.mass[0] == 0);
    CHECK(output.second_moment[0] == 0);
    CHECK(std::isnan(output.centroid[0]));
    CHECK(std::abs(output.mass[1] - 1) <= exact);
  }
}

TEST_CASE("of seeds at one position the heaviest stays, then the first") {
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const int dimension : {2, 3}) {
    DeviceDiagram diagram(caller.device(), unit_box(dimension));
    SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 700, dimension, random);
    // Repeats every second seed, with other weights and with the same one; -0 is 0.
    for (int k = 0; k < dimension; ++k) seeds.coordinate(0, k) = 0.0;
    const std::size_t unique = seeds.size();
    for (std::size_t i = 0; i < unique; i += 2) {
      for (int k = 0; k < dimension; ++k) seeds.positions.push_back(i == 0 ? -0.0 : seeds.coordinate(i, k));
      seeds.weights.push_back(seeds.weights[i] + (i % 3 == 0 ? 0.001 : i % 3 == 1 ? -0.001 : 0.0));
    }
    const Output output = run(caller, diagram, seeds.view());
    std::size_t wrong = 0;
    for (std::size_t i = 0, copy = unique; i < unique; i += 2, ++copy) {
      const std::size_t loser = i % 3 == 0 ? i : copy;
      wrong += output.status[loser] != DeviceSeedStatus::duplicate || output.mass[loser] != 0 ||
               output.status[i + copy - loser] == DeviceSeedStatus::duplicate;
    }
    CHECK(wrong == 0);
    CHECK(output.count(DeviceSeedStatus::duplicate) == (unique + 1) / 2);
    CHECK(std::abs(output.total() - 1) <= 1e-5);

    // All at one position.
    SeedArray point{dimension, std::vector<double>(static_cast<std::size_t>(dimension) * 20000, 0.3),
                    std::vector<double>(20000, 0.5)};
    point.weights[12345] = 0.75;
    const Output one = run(caller, diagram, point.view());
    CHECK(one.count(DeviceSeedStatus::duplicate) == 19999);
    CHECK(one.status[12345] == DeviceSeedStatus::ok);
    CHECK(run(caller, diagram, point.view(), false).status[0] == DeviceSeedStatus::ok);
  }
}

TEST_CASE("a leaf of the tree that begins with duplicates does not affect its other seeds") {
  // Ten seeds at one position are first on the curve, so the leaf of the others begins with two duplicates.
  Caller& caller = shared_caller();
  for (const int d : {2, 3}) {
    INFO(d << "D");
    Random random(test_seed());
    SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 5, d, random);
    for (int k = 0; k < 10; ++k) {
      seeds.positions.insert(seeds.positions.end(), static_cast<std::size_t>(d), -1.0);
      seeds.weights.push_back(0);
    }
    for (double& w : seeds.weights) w -= 15;
    DeviceDiagram diagram(caller.device(), unit_box(d));
    const Output output = run(caller, diagram, seeds.view());
    CHECK(output.total() == doctest::Approx(1).epsilon(1e-5));
    CHECK(output.count(DeviceSeedStatus::duplicate) == 9);
  }
}

TEST_CASE("seeds that are not finite are reported and do not change the others") {
  Caller& caller = shared_caller();
  Random random(test_seed());
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   inf = std::numeric_limits<double>::infinity();
  for (const int dimension : {2, 3}) {
    DeviceDiagram diagram(caller.device(), unit_box(dimension));
    const SeedArray good = random_seeds(Distribution::white, WeightRange::W1, 300, dimension, random);
    SeedArray bad = good;
    std::vector<std::pair<double, double>> values = {{nan, 0},   {inf, 0},   {-inf, 0},
                                                     {0.5, nan}, {0.5, inf}, {1e37, 0}};
    if (diagram.precision() == Precision::float64) values.emplace_back(1e300, 0);
    const double too_far = diagram.precision() == Precision::float64 ? 1e200 : 1e37;
    values.emplace_back(too_far, 0);
    std::size_t invalid = 0;
    for (const auto& [x, w] : values) {
      const bool far_but_fine = x == 1e37 && diagram.precision() == Precision::float64;
      invalid += !far_but_fine;
      for (int k = 0; k < dimension; ++k) bad.positions.push_back(k == 0 ? x : 0.5);
      bad.weights.push_back(w);
    }
    const Output expected = run(caller, diagram, good.view()), found = run(caller, diagram, bad.view());
    CHECK(found.count(DeviceSeedStatus::invalid) == invalid);
    std::size_t different = 0;
    for (std::size_t i = 0; i < good.size(); ++i)
      different += found.status[i] != expected.status[i] || std::abs(found.mass[i] - expected.mass[i]) > 1e-7;
    CHECK(different == 0);
    for (std::size_t i = good.size(); i < bad.size(); ++i)
      if (found.status[i] == DeviceSeedStatus::invalid) {
        CHECK(std::isnan(found.mass[i]));
        CHECK(std::isnan(found.second_moment[i]));
      } else {
        CHECK(found.status[i] == DeviceSeedStatus::hidden);
      }

    const SeedArray all_bad{dimension, std::vector<double>(static_cast<std::size_t>(dimension) * 50, nan),
                            std::vector<double>(50, 0.0)};
    CHECK(run(caller, diagram, all_bad.view()).count(DeviceSeedStatus::invalid) == 50);
  }
}

// An invalid seed has so low a weight that its leaf is near at bounds near the largest number only, which a
// far seed makes the search try. Leaves that do not exist then seemed near too, and were read.
TEST_CASE("an invalid seed and one far away do not disturb the search") {
  Caller& caller = shared_caller();
  Options options;
  options.precision = Precision::float32;
  DeviceDiagram diagram(caller.device(), unit_box(2), options);
  const SeedArray seeds{
      2,
      {-1.09375,  0.5,          -1.078125, -1.109375,   0.296875,  -1.09375,  1,         0.5,      -0.140625,
       -1.078125, std::nan(""), 0.15625,   -1.125,      -0.953125, -0.3125,   -1.078125, 1.171875, -1.109375,
       -1.09375,  -1.09375,     0.8125,    -1.03648e17, -1.125,    2.015625,  1.296875,  1.375,    0.953125,
       1.53125,   -0.421875,    -1.109375, 2.0625,      -1.109375, -1.109375, 2},
      {-1.578125, 1.46875, 1.234375, -0.53125, 1.46875, -0.890625, -1.625, 1.15625, -0.8125, -2, 125000000,
       -0.859375, 0.453125, -1.625, 0.875, -1.625, 1.015625}};
  SeedArray valid = seeds;
  valid.positions.erase(valid.positions.begin() + 10, valid.positions.begin() + 12);
  valid.weights.erase(valid.weights.begin() + 5);
  const Measures exact = measure(caller.device(), unit_box(2), valid.view());
  const Output found = run(caller, diagram, seeds.view());
  CHECK(found.status[5] == DeviceSeedStatus::invalid);
  for (std::size_t i = 0; i < valid.size(); ++i)
    CHECK(static_cast<int>(found.status[i < 5 ? i : i + 1]) == static_cast<int>(exact.status[i]));
}

TEST_CASE("a cell of many faces is clipped with the larger capacity") {
  Caller& caller = shared_caller();
  DeviceDiagram diagram(caller.device(), unit_box(2));
  // 100 seeds on a circle around one: its cell has 100 edges, more than the smaller capacity of 32.
  SeedArray seeds = cospherical(100, 2);
  seeds.push({0.5, 0.5}, 0);
  const Output output = run(caller, diagram, seeds.view());
  CHECK(output.status[100] == DeviceSeedStatus::ok);
  CHECK(std::abs(output.total() - 1) <= 1e-5);
  Options options;
  options.precision = diagram.precision();
  const Measures expected = measure(caller.device(), unit_box(2), seeds.view(), options);
  CHECK(std::abs(output.mass[100] - expected.mass[100]) <= 1e-5 * expected.mass[100]);
}

TEST_CASE("a cell that fits no capacity is unfinished, not partial") {
  Caller& caller = shared_caller();
  DeviceDiagram diagram(caller.device(), unit_box(2));
  SeedArray seeds = cospherical(1000, 2);
  seeds.push({0.5, 0.5}, 0);
  const Output output = run(caller, diagram, seeds.view());
  CHECK(output.status[1000] == DeviceSeedStatus::unfinished);
  CHECK(std::isnan(output.mass[1000]));
  CHECK(std::isnan(output.centroid[2000]));
  CHECK(std::isnan(output.second_moment[1000]));
  CHECK(output.count(DeviceSeedStatus::ok) == 1000);
}

TEST_CASE("pairs beyond the capacity leave their seeds unfinished, and the others unchanged") {
  Caller& caller = shared_caller();
  Random random(test_seed());
  const Domain domain = Domain::polygon(square_with_holes());
  REQUIRE(domain.region_count() > 1);
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 1000, 2, random);
  DeviceDiagram diagram(caller.device(), domain);
  const Output all = run(caller, diagram, seeds.view());
  CHECK(all.count(DeviceSeedStatus::unfinished) == 0);
  diagram.set_pair_capacity(500);
  const Output some = run(caller, diagram, seeds.view());
  const std::size_t unfinished = some.count(DeviceSeedStatus::unfinished);
  CHECK(unfinished > 0);
  CHECK(unfinished < 1000);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < seeds.size(); ++i)
    wrong += some.status[i] == DeviceSeedStatus::unfinished
                 ? !std::isnan(some.mass[i])
                 : some.mass[i] != all.mass[i] || some.status[i] != all.status[i];
  CHECK(wrong == 0);
  // With enough capacity again, nothing remains of the call before.
  diagram.set_pair_capacity(100000);
  CHECK(same(run(caller, diagram, seeds.view()), all));
}

TEST_CASE("few superfluous pairs are found") {
  Caller& caller = shared_caller();
  Random random(test_seed());
  const TetrahedralMesh mesh = ball(6);
  const Domain domain = Domain::volume(mesh.vertices, mesh.tetrahedra);
  for (const std::size_t n : {5u, 4000u}) {
    const SeedArray seeds = seeds_for(domain, Distribution::white, WeightRange::W1, n, random);
    Diagram host(caller.device(), domain);
    host.set_seeds(seeds.view());
    host.cells();  // the plan for measures does not cut cells inside the domain by region
    // The host splits regions for its tests, the device does not.
    DeviceDiagram diagram(caller.device(), domain);
    diagram.set_pair_capacity(static_cast<std::uint32_t>(host.timings().pair_count * 3 / 2));
    CHECK(run(caller, diagram, seeds.view()).count(DeviceSeedStatus::unfinished) == 0);
  }
}

TEST_CASE("facets in a bisector, after cells that left other planes in private memory") {
  Caller& caller = shared_caller();
  const Ring outer{{-1, -1}, {2, -1}, {2, 2}, {-1, 2}}, hole{{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  const Domain domain = Domain::polygon(std::vector<PolygonPart>{{outer, {hole}}});
  const SeedArray mirrored{2, {-3.5, 0.5, 0.5, -3.5}, {0, 0}};  // mirror images in the diagonal
  Random random(test_seed());
  for (const Precision precision : caller.fp64() ? std::vector{Precision::float64, Precision::float32}
                                                 : std::vector{Precision::float32}) {
    Options options;
    options.precision = precision;
    DeviceDiagram diagram(caller.device(), domain, options);
    for (int round = 0; round < 20; ++round) {
      SeedArray others{2, {}, {}};
      for (int k = 0; k < 17; ++k) others.push({random.uniform(-4, 4), random.uniform(-4, 4)}, 0);
      run(caller, diagram, others.view());
      const Output found = run(caller, diagram, mirrored.view());
      for (const double mass : found.mass) CHECK(mass == doctest::Approx(4.375).epsilon(1e-5));
    }
  }
}

TEST_CASE("results do not depend on the size of launches") {
  Caller& caller = shared_caller();
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::cluster, WeightRange::W2, 3000, 3, random);
  DeviceDiagram whole(caller.device(), unit_box(3));
  Options options;
  options.chunk_pairs = 777;
  DeviceDiagram chunked(caller.device(), unit_box(3), options);
  CHECK(same(run(caller, whole, seeds.view()), run(caller, chunked, seeds.view())));
}

TEST_CASE("invalid buffers are refused, and named") {
  Caller& caller = shared_caller();
  const Caller stranger;
  DeviceDiagram diagram(caller.device(), unit_box(2));
  const std::size_t real = diagram.precision() == Precision::float64 ? 8 : 4;
  const Memory positions(caller, 20 * real), weights(caller, 10 * real), measures(caller, 40 * real),
      status(caller, 40), small(caller, 1), foreign(stranger, 1000);
  const auto message = [&](cl_mem p, cl_mem w, cl_mem m, cl_mem s) {
    const auto error = error_of([&] { diagram.enqueue(p, w, 10, m, s); });
    REQUIRE(error);
    CHECK(error->code() == ErrorCode::invalid_argument);
    return std::string(error->what());
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  const cl_mem p = positions.handle(), w = weights.handle(), m = measures.handle(), s = status.handle();
  CHECK(has(message(nullptr, w, m, s), "positions is null"));
  CHECK(has(message(small.handle(), w, m, s), "positions has 1 bytes"));
  CHECK(has(message(p, small.handle(), m, s), "weights"));
  CHECK(has(message(p, w, small.handle(), s), "measures"));
  CHECK(has(message(p, w, m, small.handle()), "status"));
  CHECK(has(message(foreign.handle(), w, m, s), "another context"));
  const auto unsupported = error_of([&] {
    Options options;
    options.neighbors = Neighbors::flann;
    DeviceDiagram(caller.device(), unit_box(2), options);
  });
  REQUIRE(unsupported);
  CHECK(unsupported->code() == ErrorCode::unsupported);
}
