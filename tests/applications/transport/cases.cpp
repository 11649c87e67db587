#include "tests/applications/transport/cases.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace powercell::test {
namespace {

Domain centred_box(int dimension) {
  const std::array<double, 3> low{-0.5, -0.5, -0.5}, high{0.5, 0.5, 0.5};
  return Domain::box({low.data(), static_cast<std::size_t>(dimension)},
                     {high.data(), static_cast<std::size_t>(dimension)});
}

}  // namespace

MovedGrid::MovedGrid(int per_axis, int dimension, double scale, double shift)
    : domain(centred_box(dimension)) {
  const Box box{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
  const SeedArray centres = grid(per_axis, dimension, box);
  const double d = dimension, k2 = static_cast<double>(per_axis) * per_axis;
  double mean = 0, shift2 = 0;
  for (int c = 0; c < dimension; ++c) shift2 += shift * shift * (c + 1) * (c + 1);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    double weight = 0;
    for (int c = 0; c < dimension; ++c) {
      const double y = centres.coordinate(i, c), z = scale * y + shift * (c + 1);
      positions.push_back(z);
      weight += z * z - scale * y * y;
    }
    weights.push_back(weight);
    mean += weight / static_cast<double>(centres.size());
  }
  for (double& w : weights) w -= mean;
  cost = (1 - scale) * (1 - scale) * d / 12 * (1 - 1 / k2) + d / (12 * k2) + shift2;
}

std::vector<double> random_masses(std::size_t n, double range, double total, Random& random) {
  std::vector<double> masses(n);
  double sum = 0;
  for (double& m : masses) sum += m = std::pow(range, random.uniform());
  for (double& m : masses) m *= total / sum;
  return masses;
}

std::vector<TransportCase> transport_cases(std::size_t n, double range) {
  Random shape(3), random(test_seed());
  std::vector<TransportCase> cases;
  const auto add = [&](const std::string& name, const Domain& domain) {
    SeedArray seeds = seeds_for(domain, Distribution::white, WeightRange::W0, n, random);
    cases.push_back({name, domain, seeds, random_masses(n, range, domain.measure(), random)});
  };
  add("square", unit_box(2));
  add("letter U", Domain::polygon(letter_u()));
  add("square with holes", Domain::polygon(square_with_holes()));
  add("cube", unit_box(3));
  add("meshed cube", volume_of(cube_tetrahedra(3, 0.15, shape)));
  const TetrahedralMesh round = powercell::ball(4);
  add("ball", Domain::volume(round.vertices, round.tetrahedra));
  const TriangleMesh skin = powercell::sphere(8), ring = powercell::torus(12);
  add("sphere", Domain::surface(skin.vertices, skin.triangles));
  add("torus", Domain::surface(ring.vertices, ring.triangles));
  return cases;
}

TransportOptions transport_options(Precision precision) {
  TransportOptions options;
  options.diagram.precision = precision;
  return options;
}

const Device& transport_device() {
  return main_setups().front().device;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

}  // namespace powercell::test
