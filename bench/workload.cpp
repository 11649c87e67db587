#include "bench/workload.hpp"

#include <cmath>
#include <fstream>
#include <numbers>
#include <powercell/shapes.hpp>
#include <stdexcept>

#include "tests/support/domains.hpp"

namespace powercell::bench {

using namespace powercell::test;

namespace {

constexpr double tube = 0.4;  // radius of the tube of powercell::torus, whose centre circle has radius 1

/// The angle a across the tube below which the fraction u of the torus's area lies: (a + tube sin a) / 2 pi =
/// u.
double angle_across(double u) {
  double a = 2 * std::numbers::pi * u;
  for (int k = 0; k < 50; ++k) {
    const double step = (a + tube * std::sin(a) - 2 * std::numbers::pi * u) / (1 + tube * std::cos(a));
    a -= step;
    if (std::abs(step) < 1e-15) break;
  }
  return a;
}

SeedArray on_torus(const SeedArray& square) {
  SeedArray seeds{3, std::vector<double>(3 * square.size()), square.weights};
  for (std::size_t i = 0; i < square.size(); ++i) {
    const double around = 2 * std::numbers::pi * square.coordinate(i, 0),
                 across = angle_across(square.coordinate(i, 1)), r = 1 + tube * std::cos(across);
    seeds.coordinate(i, 0) = r * std::cos(around);
    seeds.coordinate(i, 1) = r * std::sin(around);
    seeds.coordinate(i, 2) = tube * std::sin(across);
  }
  return seeds;
}

}  // namespace

std::string Work::name(const std::string& stage, const std::string& precision,
                       const std::string& provider) const {
  return stage + "/" + domain + "/" + test::name(distribution) + "/" + test::name(weights) + "/" + precision +
         "/" + provider + "/" + std::to_string(n);
}

namespace {

/// The vertices and tetrahedra of a Medit file without other elements.
Mesh read_tetrahedra(const std::string& path) {
  std::ifstream file(path);
  Mesh mesh;
  for (std::string word; file >> word;) {
    std::size_t count = 0;
    if (word == "Vertices" || word == "Tetrahedra") file >> count;
    for (std::size_t row = 0; row < count; ++row) {
      for (int k = 0; k < (word == "Vertices" ? 3 : 4); ++k) {
        double number = 0;
        file >> number;
        if (word == "Vertices")
          mesh.vertices.push_back(number);
        else
          mesh.elements.push_back(static_cast<std::uint32_t>(number) - 1);
      }
      double reference = 0;
      file >> reference;
    }
  }
  if (!file.eof() || mesh.elements.empty()) throw std::invalid_argument("cannot read " + path);
  return mesh;
}

/// Tetrahedra on one side of a gyroid, three of its cells along each axis of the cube: a body as full of
/// channels as a bone.
Mesh gyroid() {
  Random random(7);
  return part_of(cube_tetrahedra(30, 0, random), [](const std::array<double, 3>& x) {
    const double turns = 6 * std::numbers::pi;
    return std::sin(turns * x[0]) * std::cos(turns * x[1]) + std::sin(turns * x[1]) * std::cos(turns * x[2]) +
               std::sin(turns * x[2]) * std::cos(turns * x[0]) <
           -0.4;
  });
}

}  // namespace

Mesh mesh_of(const std::string& name) {
  if (name == "surface") {
    TriangleMesh mesh = torus(32);
    return {std::move(mesh.vertices), std::move(mesh.triangles)};
  }
  if (name == "tets") {
    Random random(7);  // fixed, since the shape is part of the work
    return cube_tetrahedra(14, 0.15, random);
  }
  if (name == "bracket") return read_tetrahedra(POWERCELL_DATA "/bracket.mesh");
  if (name == "gyroid") return gyroid();
  throw std::invalid_argument("unknown mesh '" + name + "'");
}

Domain domain_of(const std::string& name) {
  if (name == "box2") return unit_box(2);
  if (name == "box3") return unit_box(3);
  if (name == "islands") return Domain::polygon(islands());
  const Mesh mesh = mesh_of(name);
  return name == "surface" ? surface_of(mesh) : volume_of(mesh);
}

bool is_box(const std::string& domain) {
  return domain == "box2" || domain == "box3";
}

int dimension_of(const std::string& domain) {
  return domain == "box2" || domain == "islands" ? 2 : 3;
}

SeedArray seeds_of(const Work& work) {
  Random random(1);
  if (work.domain == "islands" || work.domain == "bracket")
    return seeds_for(domain_of(work.domain), work.distribution, work.weights, work.n, random);
  if (work.domain != "surface")
    return random_seeds(work.distribution, work.weights, work.n, dimension_of(work.domain), random);
  SeedArray seeds = on_torus(scatter(work.distribution, work.n, 2, {}, random));
  const double h = spacing(domain_of(work.domain).measure(), work.n, 2);
  for (double& x : seeds.positions) x += 0.5 * h * random.uniform(-1, 1);
  set_weights(seeds, work.weights, h, random);
  return seeds;
}

}  // namespace powercell::bench
