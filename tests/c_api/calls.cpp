// Callbacks that fail or throw, and threads.
#include <cmath>
#include <stdexcept>
#include <thread>

#include "tests/c_api/handles.hpp"

using namespace powercell::c_api_test;

TEST_CASE("a progress function that throws stops the call, with its exception as the message") {
  Domain domain;
  REQUIRE(pc_domain_box(low, high, 2, &domain.handle) == PC_OK);
  const double position[2] = {1, 0.5};
  pc_options options;
  REQUIRE(pc_options_init(&options, sizeof options) == PC_OK);
  bool broken = true;
  options.progress_user = &broken;
  const auto check = [&](pc_progress progress, const char* message) {
    Diagram diagram;
    broken = true;
    options.progress = progress;
    REQUIRE(pc_diagram_create(shared_device(), domain.handle, &options, &diagram.handle) == PC_OK);
    REQUIRE(pc_diagram_set_seeds(diagram.handle, position, nullptr, 1) == PC_OK);
    CHECK(pc_diagram_measures(diagram.handle, nullptr, nullptr, nullptr, nullptr) == PC_INTERRUPTED);
    CHECK(message_has(message));
    broken = false;  // the diagram can be used again
    double mass = 0;
    REQUIRE(pc_diagram_measures(diagram.handle, &mass, nullptr, nullptr, nullptr) == PC_OK);
    CHECK(mass == doctest::Approx(2).epsilon(1e-5));
  };
  check(
      [](double, void* user) {
        if (*static_cast<bool*>(user)) throw std::runtime_error("the window was closed");
        return 1;
      },
      "the window was closed");
  check(
      [](double, void* user) {
        if (*static_cast<bool*>(user)) throw 3;
        return 1;
      },
      "of unknown type");
}

TEST_CASE("two threads with diagrams of their own share a device and a domain, and have their own messages") {
  Domain domain;
  REQUIRE(pc_domain_box(low, high, 2, &domain.handle) == PC_OK);
  std::string messages[2];
  double masses[2] = {};
  pc_device* const device = shared_device();
  const auto work = [&](int w) {
    pc_diagram* diagram = nullptr;
    const double positions[4] = {0.25, 0.5, 1.75, 0.5};
    if (pc_diagram_create(device, domain.handle, nullptr, &diagram) != PC_OK) return;
    for (int round = 0; round < 5; ++round) {
      const double weights[2] = {0.1 * round * (w + 1), 0};
      double mass[2] = {};
      pc_diagram_set_seeds(diagram, positions, weights, 2);
      if (pc_diagram_measures(diagram, mass, nullptr, nullptr, nullptr) == PC_OK) masses[w] = mass[0];
      pc_diagram_set_weights(diagram, weights, static_cast<size_t>(w) + 3);
      messages[w] = pc_last_error();
    }
    pc_diagram_destroy(diagram);
  };
  std::thread other(work, 1);
  work(0);
  other.join();
  for (int w = 0; w < 2; ++w) {
    // The wall is at 1 + w_0 / (2 * 1.5), as far as the domain goes.
    CHECK(masses[w] == doctest::Approx(1 + 0.4 * (w + 1) / 3).epsilon(1e-5));
    CHECK(messages[w].find(std::to_string(w + 3)) != std::string::npos);
  }
}
