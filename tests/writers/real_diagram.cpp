#include "tests/writers/real_diagram.hpp"

#include <cmath>
#include <random>

#include "apps/io/read/domain.hpp"
#include "tests/writers/made_diagram.hpp"

namespace powercell::test {
namespace {

Domain named(const std::string& spec) {
  return io::read_domain(spec).domain;
}

Domain solid(const std::string& spec) {
  const io::LoadedDomain surface = io::read_domain(spec);
  return Domain::solid(surface.vertices, surface.elements);
}

Domain box(std::vector<double> low, std::vector<double> high) {
  return Domain::box(low, high);
}

}  // namespace

io::DiagramOutput RealDiagram::output() {
  const bool is_solid = diagram->domain().is_solid();
  return {diagram->domain(),   {diagram->domain().dimension(), positions, weights},
          diagram->measures(), is_solid ? none : diagram->cells(),
          diagram->joined(),   diagram->adjacency()};
}

RealDiagram real_diagram(const std::string& name, const Domain& domain, std::vector<double> seeds,
                         std::vector<double> weights, const Options& options) {
  static const Device device = Device::choose();
  if (weights.empty()) weights.assign(seeds.size() / static_cast<std::size_t>(domain.dimension()), 0.0);
  RealDiagram real{name, std::make_shared<Diagram>(device, domain, options), std::move(seeds),
                   std::move(weights)};
  real.diagram->set_seeds({domain.dimension(), real.positions, real.weights});
  real.diagram->compute(true, !domain.is_solid());
  return real;
}

RealDiagram random_diagram(const std::string& name, const Domain& domain, std::size_t n,
                           const Options& options) {
  std::mt19937_64 random(11);
  const auto low = domain.low(), high = domain.high();
  std::vector<double> positions, weights;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < static_cast<std::size_t>(domain.dimension()); ++k)
      positions.push_back(uniform(random, low[k], high[k]));
  const double spacing = std::pow(domain.measure() / static_cast<double>(n), 1.0 / domain.cell_dimension());
  for (std::size_t i = 0; i < n; ++i) weights.push_back(uniform(random, -0.3, 0.3) * spacing * spacing);
  return real_diagram(name, domain, std::move(positions), std::move(weights), options);
}

std::vector<double> lattice_points(std::size_t per_axis, std::size_t dimension) {
  std::vector<double> points;
  std::size_t count = 1;
  for (std::size_t k = 0; k < dimension; ++k) count *= per_axis;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0, rest = i; k < dimension; ++k, rest /= per_axis)
      points.push_back((static_cast<double>(rest % per_axis) + 0.5) / static_cast<double>(per_axis));
  return points;
}

Domain plate_with_hole() {
  std::vector<double> vertices;
  for (int z = 0; z < 2; ++z)
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) vertices.insert(vertices.end(), {x / 3.0, y / 3.0, z / 3.0});
  const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  const std::uint32_t step[3] = {1, 4, 16};
  std::vector<std::uint32_t> tetrahedra;
  for (std::uint32_t y = 0; y < 3; ++y)
    for (std::uint32_t x = 0; x < 3; ++x) {
      if (x == 1 && y == 1) continue;
      for (const auto& axes : order) {
        std::uint32_t v = x + 4 * y;
        tetrahedra.push_back(v);
        for (const int axis : axes) tetrahedra.push_back(v += step[axis]);
      }
    }
  return Domain::volume(vertices, tetrahedra);
}

Domain square_with_hole() {
  PolygonPart part;
  part.outer = {{0, 0}, {3, 0}, {3, 3}, {0, 3}};
  part.holes.push_back({{1, 1}, {2, 1}, {2, 2}, {1, 2}});
  return Domain::polygon(std::span(&part, 1));
}

std::vector<RealDiagram> volume_cases() {
  std::vector<RealDiagram> cases;
  Options single;
  single.precision = Precision::float32;
  cases.push_back(random_diagram("box", box({0, 0, 0}, {2, 1, 1}), 400));
  cases.push_back(
      random_diagram("box far from the origin", box({500000, 5600000, 0}, {500002, 5600001, 1}), 100));
  cases.push_back(real_diagram("lattice", named("cube"), lattice_points(4, 3)));
  cases.push_back(random_diagram("ball", named("ball:3"), 60));
  cases.push_back(random_diagram("plate", plate_with_hole(), 30));
  cases.push_back(real_diagram("plate, walls with holes", plate_with_hole(),
                               {0.5, 0.5, 0.05, 0.5, 0.5, 0.15, 0.51, 0.48, 0.25, 0.1, 0.2, 0.27}));
  cases.push_back(real_diagram("plate, walls in facets", plate_with_hole(), lattice_points(3, 3)));
  cases.push_back(random_diagram("solid", solid("sphere:6"), 60));
  cases.push_back(random_diagram("solid torus", solid("torus:12"), 40));
  cases.push_back(random_diagram("single precision", named("ball:2"), 40, single));
  return cases;
}

std::vector<RealDiagram> flat_cases() {
  std::vector<RealDiagram> cases;
  cases.push_back(random_diagram("square", named("square"), 300));
  cases.push_back(real_diagram("lattice", named("square"), lattice_points(7, 2)));
  cases.push_back(random_diagram("hole", square_with_hole(), 40));
  cases.push_back(real_diagram("cells with holes", square_with_hole(), {0.4, 0.4, 2.9, 0.2, 2.95, 0.1}));
  cases.push_back(random_diagram("disk", named("disk:40"), 50));
  cases.push_back(random_diagram("torus", named("torus:12"), 60));
  return cases;
}

}  // namespace powercell::test
