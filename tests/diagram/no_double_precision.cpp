#include <doctest/doctest.h>

#include <memory>
#include <powercell/diagram.hpp>
#include <string>

#include "lib/cl/context.hpp"
#include "tests/clip/random_scene.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// The test device as if it had no double precision.
Device single_precision_device() {
  const auto real = test_context();
  DeviceInfo info = real->info();
  info.fp64 = false;
  return Device(std::make_shared<cl::Context>(cl::SharedContext::of_device(real->device()), info));
}

}  // namespace

TEST_CASE("a device without double precision refuses it, and computes in single precision") {
  const Device device = single_precision_device();
  Options options;
  options.precision = Precision::float64;
  try {
    Diagram diagram(device, unit_box(3), options);
    FAIL("double precision was accepted");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::no_fp64);
    CHECK(std::string(error.what()).find(device.info().name) != std::string::npos);
    CHECK(std::string(error.what()).find("single precision") != std::string::npos);
  }

  Diagram diagram(device, unit_box(3));
  CHECK(diagram.precision() == Precision::float32);
  const auto [positions, weights] = RandomScene::random_values(3, 200, 0.5);
  diagram.set_seeds({3, positions, weights});
  CHECK(diagram.measures().relative_error() < 1e-5);
  CHECK(diagram.measures().count(SeedStatus::ok) > 150);
}
