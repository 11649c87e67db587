#include <cmath>
#include <random>

#include "tests/writers/made_diagram.hpp"

namespace powercell::test {
namespace {

constexpr double tau = 6.283185307179586;

Ring blob(double radius, double wave, int lobes, int points, double x, double y) {
  Ring ring;
  for (int k = 0; k < points; ++k) {
    const double angle = tau * k / points;
    const double r = radius * (1 + wave * std::cos(lobes * angle));
    ring.push_back({x + r * std::cos(angle), y + r * std::sin(angle)});
  }
  return ring;
}

}  // namespace

MadeDiagram polygon_diagram(int n) {
  PolygonPart part;
  part.outer = blob(1, 0.22, 3, 90, 0, 0);
  part.holes.push_back(blob(0.26, 0.1, 4, 40, -0.05, 0.1));
  const Domain domain = Domain::polygon(std::span(&part, 1));
  std::mt19937_64 random(7);
  std::vector<double> positions, weights;
  const double spacing = std::sqrt(domain.measure() / n);
  for (int i = 0; i < n; ++i) {
    positions.push_back(uniform(random, -1.15, 1.25));
    positions.push_back(uniform(random, -1.15, 1.15));
    const double radius = spacing * uniform(random, 0.05, 0.75);
    weights.push_back(i % 5 == 0 ? -0.2 * radius * radius : radius * radius);
  }
  if (n > 1) {
    positions[2] = positions[0];
    positions[3] = positions[1];
  }
  return make_diagram(domain, positions, weights);
}

MadeDiagram surface_diagram(int n) {
  constexpr int around = 36, across = 18;
  std::vector<double> vertices;
  std::vector<std::uint32_t> triangles;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = tau * i / around, v = tau * j / across;
      const double r = 1 + 0.42 * std::cos(v);
      vertices.insert(vertices.end(), {r * std::cos(u), r * std::sin(u), 0.42 * std::sin(v)});
      const auto at = [](int a, int b) {
        return static_cast<std::uint32_t>((a % around) * across + b % across);
      };
      triangles.insert(triangles.end(), {at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.insert(triangles.end(), {at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  const Domain domain = Domain::surface(vertices, triangles);
  std::mt19937_64 random(11);
  std::vector<double> positions, weights;
  const double h2 = domain.measure() / n;
  for (int i = 0; i < n; ++i) {
    const double u = uniform(random, 0, tau), v = uniform(random, 0, tau), r = 1 + 0.42 * std::cos(v);
    positions.insert(positions.end(), {r * std::cos(u), r * std::sin(u), 0.42 * std::sin(v)});
    weights.push_back(uniform(random, 0, 0.6 * h2));
  }
  return make_diagram(domain, positions, weights);
}

MadeDiagram volume_diagram(int n) {
  // Kuhn's six tetrahedra around the diagonal of the cube.
  std::vector<double> vertices;
  for (int k = 0; k < 8; ++k)
    vertices.insert(vertices.end(), {double(k & 1), double(k >> 1 & 1), double(k >> 2)});
  const std::vector<std::uint32_t> tetrahedra = {0, 1, 3, 7, 0, 3, 2, 7, 0, 2, 6, 7,
                                                 0, 6, 4, 7, 0, 4, 5, 7, 0, 5, 1, 7};
  const Domain domain = Domain::volume(vertices, tetrahedra);
  std::mt19937_64 random(3);
  std::vector<double> positions, weights;
  const double h = std::cbrt(1.0 / n);
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < 3; ++k) positions.push_back(uniform(random, 0, 1));
    weights.push_back(uniform(random, 0, 0.5 * h * h));
  }
  return make_diagram(domain, positions, weights);
}

}  // namespace powercell::test
