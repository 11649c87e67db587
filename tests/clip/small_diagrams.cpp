#include <doctest/doctest.h>

#include <powercell/diagram.hpp>
#include <powercell/shapes.hpp>

#include "tests/clip/random_scene.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

Domain small_domain(DomainKind kind) {
  if (kind == DomainKind::surface) {
    const TriangleMesh mesh = sphere(1);
    return Domain::surface(mesh.vertices, mesh.triangles);
  }
  if (kind == DomainKind::volume) {
    const TetrahedralMesh mesh = ball(1);
    return Domain::volume(mesh.vertices, mesh.tetrahedra);
  }
  const PolygonPart part{{{0, 0}, {1, 0}, {1, 1}, {0.5, 0.4}, {0, 1}}, {}};
  return Domain::polygon({&part, 1});
}

}  // namespace

// Also run under oclgrind (tests/oclgrind/run.sh), which is slow: few seeds, every output.
TEST_CASE("small diagrams of each kind of domain") {
  static const Device device(test_context());
  for (const DomainKind kind : {DomainKind::polygon, DomainKind::surface, DomainKind::volume})
    for (const Precision precision : {Precision::float32, Precision::float64}) {
      if (precision == Precision::float64 && !device.info().fp64) continue;
      const Domain domain = small_domain(kind);
      Options options;
      options.precision = precision;
      Diagram diagram(device, domain, options);
      const auto [positions, weights] = RandomScene::random_values(domain.dimension(), 12, 0.5);
      diagram.set_seeds({domain.dimension(), positions, weights});
      diagram.compute(true, true);
      CAPTURE(static_cast<int>(kind));
      CHECK(diagram.measures().relative_error() < (precision == Precision::float32 ? 1e-5 : 1e-13));
      CHECK(diagram.cells().piece_count() >= diagram.measures().count(SeedStatus::ok));
      CHECK(diagram.adjacency().neighbor.size() > 0);
    }
}
