// Domains of several parts: masses must cross gaps many cells wide.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/applications/transport/cases.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// low and high corner; flat in z on surfaces, and in the plane
using Island = std::array<double, 6>;

Domain islands(const std::vector<Island>& boxes, DomainKind kind) {
  std::vector<PolygonPart> parts;
  std::vector<double> vertices;
  std::vector<std::uint32_t> elements;
  for (const Island& b : boxes) {
    const auto first = static_cast<std::uint32_t>(vertices.size() / 3);
    const auto corner = [&](std::size_t k, std::size_t c) { return b[c + ((k >> c & 1) != 0 ? 3 : 0)]; };
    const std::size_t corners = kind == DomainKind::volume ? 8 : 4;
    for (std::size_t k = 0; k < corners; ++k)
      vertices.insert(vertices.end(), {corner(k, 0), corner(k, 1), corner(k, 2)});
    const auto add = [&](std::initializer_list<std::uint32_t> corners_of) {
      for (const std::uint32_t k : corners_of) elements.push_back(first + k);
    };
    if (kind == DomainKind::polygon)
      parts.push_back({{{b[0], b[1]}, {b[3], b[1]}, {b[3], b[4]}, {b[0], b[4]}}, {}});
    else if (kind == DomainKind::surface)
      add({0, 1, 3, 0, 3, 2});
    else
      add({0, 1, 3, 7, 0, 1, 5, 7, 0, 2, 3, 7, 0, 2, 6, 7, 0, 4, 5, 7, 0, 4, 6, 7});
  }
  if (kind == DomainKind::polygon) return Domain::polygon(parts);
  return kind == DomainKind::surface ? Domain::surface(vertices, elements)
                                     : Domain::volume(vertices, elements);
}

struct Case {
  std::vector<Island> boxes;
  std::vector<double> positions, masses;
  DomainKind kind = DomainKind::polygon;

  /// Draws n seeds in the boxes, with masses over so many orders.
  void draw(Random& random, std::size_t n, double orders) {
    const std::size_t d = kind == DomainKind::polygon ? 2 : 3;
    for (std::size_t i = 0; i < n; ++i) {
      const Island& b =
          boxes[static_cast<std::size_t>(random.uniform(0, 1) * static_cast<double>(boxes.size()))];
      for (std::size_t c = 0; c < d; ++c)
        positions.push_back(b[c] + (b[c + 3] - b[c]) * random.uniform(0, 1));
      masses.push_back(std::pow(10, orders * random.uniform(0, 1)));
    }
  }
  TransportResult solve() const {
    TransportOptions options = transport_options();
    options.rescale = true;
    return transport(transport_device(), islands(boxes, kind),
                     {kind == DomainKind::polygon ? 2 : 3, positions, {}}, masses, options);
  }
};

void check(const TransportResult& found, std::size_t most_diagrams) {
  CHECK(found.converged);
  CHECK(found.diagrams <= most_diagrams);
  for (std::size_t i = 0; i < found.mass.size(); ++i)
    CHECK(std::abs(found.mass[i] / found.target[i] - 1) < std::max(1e-6, found.rounding_error));
}

}  // namespace

TEST_CASE("gaps: two unit squares 100 apart, four seeds") {
  Case two;
  two.boxes = {{0, 0, 0, 1, 1, 0}, {101, 0, 0, 102, 1, 0}};
  two.positions = {0.2, 0.3, 0.7, 0.6, 101.4, 0.5, 101.8, 0.1};
  two.masses = {3.4, 10.7, 15.5, 670.2};
  check(two.solve(), 60);
}

TEST_CASE("gaps: seeds on a line have strips whose centroids follow from running sums") {
  INFO(replay_hint());
  Random random(test_seed());
  Case two;
  two.boxes = {{0, 0, 0, 1, 1, 0}, {101, 0, 0, 102, 1, 0}};
  for (int k = 0; k < 50; ++k) {
    two.positions.insert(two.positions.end(),
                         {(k < 30 ? 0.03 * k : 98 + 0.1 * k) + 0.02 * random.uniform(0, 1), 0.5});
    two.masses.push_back(std::pow(10, 2 * random.uniform(0, 1)));
  }
  const TransportResult found = two.solve();
  check(found, 60);
  // Integral of x over the leftmost area t.
  const auto moment = [](double t) {
    return t < 1 ? t * t / 2 : 0.5 + 101 * (t - 1) + (t - 1) * (t - 1) / 2;
  };
  double below = 0;
  for (std::size_t i = 0; i < found.target.size(); ++i) {
    const double above = below + found.target[i];
    const double center = (moment(above) - moment(below)) / found.target[i];
    CHECK(found.centroid[2 * i] == doctest::Approx(center).epsilon(1e-5));
    below = above;
  }
}

TEST_CASE("gaps: a small square beside a large one, 1,000 seeds") {
  INFO(replay_hint());
  Random random(test_seed());
  Case two;
  two.boxes = {{0, 0, 0, 1, 1, 0}, {1.5, 0, 0, 1.7, 0.2, 0}};
  two.draw(random, 1000, 0);
  check(two.solve(), 30);
}

TEST_CASE("gaps: eight islands, masses over six orders") {
  INFO(replay_hint());
  Random random(test_seed());
  Case eight;
  for (int k = 0; k < 8; ++k) eight.boxes.push_back({3.0 * k, 0, 0, 3.0 * k + 1, 1, 0});
  eight.draw(random, 64, 6);
  check(eight.solve(), 60);
}

TEST_CASE("gaps: seeds that all lie in one of three parts, or outside") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const Island& seeds : {Island{0, 0, 0, 0.3, 0.3, 0}, Island{-90, 40, 0, -80, 41, 0}}) {
    Case three;
    three.boxes = {seeds};
    three.draw(random, 300, 1);
    three.boxes = {{0, 0, 0, 1, 1, 0}, {4, 0, 0, 4.5, 1, 0}, {50, 9, 0, 51, 9.5, 0}};
    check(three.solve(), 60);
  }
}

TEST_CASE("gaps: few seeds on islands of every kind, far apart") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const DomainKind kind : {DomainKind::polygon, DomainKind::surface, DomainKind::volume})
    for (const double gap : {1.0, 30.0, 3000.0}) {
      CAPTURE(static_cast<int>(kind));
      CAPTURE(gap);
      Case islands;
      islands.kind = kind;
      double x = 0;
      for (int k = 0; k < 5; ++k, x += 1 + gap)
        islands.boxes.push_back({x, 0, 0, x + 0.5 + 0.1 * k, 0.7, kind == DomainKind::volume ? 0.6 : 0.0});
      islands.draw(random, 40, 2);
      check(islands.solve(), 60);
    }
}
