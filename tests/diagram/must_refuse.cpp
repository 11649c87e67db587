// Bad input is refused with the right error code and a message that names the element.
#include <doctest/doctest.h>

#include <limits>

#include "tests/diagram/check.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The message of the Error that `action` throws, after checking its code.
template <class Action>
std::string refusal(ErrorCode code, Action action) {
  try {
    action();
  } catch (const Error& error) {
    INFO(error.what());
    CHECK(std::string(name(error.code())) == name(code));
    return error.what();
  }
  FAIL_CHECK("not refused");
  return {};
}

bool mentions(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

Diagram square_diagram() {
  return {main_setups().front().device, unit_box(2), main_setups().front().options};
}

}  // namespace

TEST_CASE("NaN or infinity in seeds: the message names the seed") {
  for (const double bad : {not_a_number, infinity, -infinity}) {
    SeedArray seeds = grid(6, 2);
    seeds.coordinate(23, 1) = bad;
    std::string message = refusal(ErrorCode::invalid_seed, [&] { square_diagram().set_seeds(seeds.view()); });
    CHECK_MESSAGE(mentions(message, "23"), message);
    seeds = grid(6, 2);
    seeds.weights[31] = bad;
    message = refusal(ErrorCode::invalid_seed, [&] { square_diagram().set_seeds(seeds.view()); });
    CHECK_MESSAGE(mentions(message, "31"), message);
    message = refusal(ErrorCode::invalid_seed, [&] {
      Diagram diagram = square_diagram();
      const SeedArray good = grid(6, 2);
      diagram.set_seeds(good.view());
      diagram.set_weights(seeds.weights);
    });
    CHECK_MESSAGE(mentions(message, "31"), message);
  }
}

TEST_CASE("sizes that do not match") {
  const SeedArray seeds = grid(3, 2);
  const std::vector<double> short_weights(8, 0.0);
  refusal(ErrorCode::invalid_argument, [&] {
    square_diagram().set_seeds({2, seeds.positions, short_weights});
  });
  const std::vector<double> odd(7, 0.5);
  refusal(ErrorCode::invalid_argument, [&] { square_diagram().set_seeds({2, odd, {}}); });
  refusal(ErrorCode::invalid_argument, [&] {
    Diagram diagram = square_diagram();
    diagram.set_seeds(seeds.view());
    diagram.set_weights(short_weights);
  });
}

TEST_CASE("seeds of another dimension than the domain") {
  const SeedArray solid = grid(3, 3), flat = grid(3, 2);
  refusal(ErrorCode::invalid_argument, [&] { square_diagram().set_seeds(solid.view()); });
  refusal(ErrorCode::invalid_argument, [&] {
    Diagram diagram(main_setups().front().device, unit_box(3));
    diagram.set_seeds(flat.view());
  });
  refusal(ErrorCode::invalid_argument, [&] { square_diagram().set_seeds({0, flat.positions, {}}); });
}

TEST_CASE("mesh indices out of range: the message names the element") {
  Mesh surface = wavy_patch(3);
  surface.elements[3 * 5 + 1] = 999;
  std::string message = refusal(ErrorCode::invalid_domain, [&] { surface_of(surface); });
  CHECK_MESSAGE(mentions(message, "5"), message);
  Mesh ball = ball_tetrahedra(0);
  ball.elements[4 * 7 + 3] = 999;
  message = refusal(ErrorCode::invalid_domain, [&] { volume_of(ball); });
  CHECK_MESSAGE(mentions(message, "7"), message);
}

TEST_CASE("arrays of a mesh with an incomplete element or vertex") {
  Mesh mesh = wavy_patch(3);
  mesh.elements.pop_back();
  CHECK_THROWS_AS(surface_of(mesh), Error);
  mesh = wavy_patch(3);
  mesh.vertices.pop_back();
  CHECK_THROWS_AS(surface_of(mesh), Error);
  mesh = ball_tetrahedra(0);
  mesh.elements.pop_back();
  CHECK_THROWS_AS(volume_of(mesh), Error);
}

TEST_CASE("NaN or infinity in a domain") {
  for (const double bad : {not_a_number, infinity}) {
    Mesh mesh = wavy_patch(3);
    mesh.vertices[4] = bad;
    refusal(ErrorCode::invalid_domain, [&] { surface_of(mesh); });
    Mesh ball = ball_tetrahedra(0);
    ball.vertices[4] = bad;
    refusal(ErrorCode::invalid_domain, [&] { volume_of(ball); });
    Parts parts = unit_square();
    parts[0].outer[2][0] = bad;
    refusal(ErrorCode::invalid_domain, [&] { Domain::polygon(parts); });
    const std::vector<double> low{0, 0}, high{1, bad};
    refusal(ErrorCode::invalid_domain, [&] { Domain::box(low, high); });
  }
}

TEST_CASE("invalid polygons") {
  refusal(ErrorCode::invalid_domain, [] { Domain::polygon(Parts{{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, {}}}); });
  refusal(ErrorCode::invalid_domain, [] { Domain::polygon(Parts{{{{0, 0}, {1, 1}}, {}}}); });
  refusal(ErrorCode::invalid_domain, [] { Domain::polygon(Parts{{{{0, 0}, {1, 1}, {2, 2}}, {}}}); });
  // A hole that sticks out, and a part that overlaps another.
  Parts parts = unit_square();
  parts[0].holes.push_back({{0.5, 0.5}, {1.5, 0.5}, {0.5, 0.8}});
  refusal(ErrorCode::invalid_domain, [&] { Domain::polygon(parts); });
  parts = unit_square();
  parts.push_back({{{0.5, 0.5}, {1.5, 0.5}, {1.5, 1.5}, {0.5, 1.5}}, {}});
  const std::string message = refusal(ErrorCode::invalid_domain, [&] { Domain::polygon(parts); });
  CHECK_FALSE(message.empty());
}

TEST_CASE("empty domains") {
  refusal(ErrorCode::invalid_domain, [] { Domain::polygon(Parts{}); });
  refusal(ErrorCode::invalid_domain, [] { Domain::surface({}, {}); });
  refusal(ErrorCode::invalid_domain, [] { Domain::volume({}, {}); });
  Mesh flat;
  flat.vertices = {0, 0, 0, 1, 0, 0, 2, 0, 0};
  flat.elements = {0, 1, 2};
  refusal(ErrorCode::invalid_domain, [&] { surface_of(flat); });
  const std::vector<double> low{0, 1}, high{1, 1}, four(4, 1.0), zero(4, 0.0);
  refusal(ErrorCode::invalid_domain, [&] { Domain::box(low, high); });
  refusal(ErrorCode::invalid_domain, [&] { Domain::box(high, low); });
  refusal(ErrorCode::invalid_domain, [&] { Domain::box(zero, four); });
}

TEST_CASE("a device that does not exist: the message lists the devices") {
  const std::string message = refusal(ErrorCode::device_not_found, [] { Device::choose("no such device"); });
  for (const DeviceInfo& info : devices()) CHECK_MESSAGE(mentions(message, info.name), message);
  refusal(ErrorCode::device_not_found, [] { Device::choose("97:0"); });
}

TEST_CASE("options out of range") {
  const Device& device = main_setups().front().device;
  Options options;
  options.neighbors = Neighbors::flann;
  options.initial_neighbors = -1;
  refusal(ErrorCode::invalid_argument, [&] { Diagram(device, unit_box(2), options); });
  options = {};
  options.threads = -1;
  refusal(ErrorCode::invalid_argument, [&] { Diagram(device, unit_box(2), options); });
#ifdef POWERCELL_TEST_FLANN
  options = {};
  options.neighbors = Neighbors::flann;
  options.lift_eta = 0.5;  // below the largest weight, so that (5) has the root of a negative number
  SeedArray seeds = grid(5, 2);
  seeds.weights[7] = 1;
  refusal(ErrorCode::invalid_argument, [&] { measure(device, unit_box(2), seeds.view(), options); });
  for (const Precision precision : {Precision::automatic, Precision::float32})
    for (const double beyond :
         {precision == Precision::float32 ? 1e35 : 1e281, std::numeric_limits<double>::max(),
          std::numeric_limits<double>::infinity()}) {  // all distances would be infinite
      options.precision = precision;
      options.lift_eta = beyond;
      const std::string message =
          refusal(ErrorCode::invalid_argument, [&] { measure(device, unit_box(2), seeds.view(), options); });
      CHECK_MESSAGE(mentions(message, "height of the lift"), message);
    }
#endif
}
