// Cones and thin plates, whose cells reach around a tip or to another sheet, and the repair of such cells.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <powercell/remeshing.hpp>

#include "lib/applications/remeshing/cell_loop.hpp"
#include "lib/applications/remeshing/sampling.hpp"
#include "tests/applications/remeshing/shapes.hpp"
#include "tests/applications/remeshing/surface_from.hpp"

namespace powercell::test {
namespace {

using namespace remeshing;

void check_remeshes(const TriangleMesh& mesh, std::size_t count) {
  RemeshOptions options;
  options.count = count;
  options.rounds = 3;
  const TriangleMesh result = remesh(mesh.vertices, mesh.triangles, options).mesh;
  const MeshQuality quality = mesh_quality(result.vertices, result.triangles);
  CHECK(quality.vertices == count);
  CHECK(quality.manifold);
  CHECK(quality.euler_characteristic == 2);
  CHECK(quality.boundary_loops == 0);
  CHECK(farthest_from(result, mesh, 10000) < 0.1);
}

double angle_of(const Place& place) {
  return std::atan2(place.at.y, place.at.x);
}

}  // namespace

TEST_CASE("cones with sharp tips and rims are remeshed") {
  for (const double radius : {0.1, 0.2, 0.3, 1.0})
    for (const std::size_t count : {50, 300}) {
      CAPTURE(radius);
      CAPTURE(count);
      check_remeshes(cone(24, radius), count);
    }
}

TEST_CASE("plates much thinner than the new edges are remeshed") {
  for (const double thickness : {0.02, 1e-4}) {
    CAPTURE(thickness);
    check_remeshes(plate(thickness), 200);
  }
}

TEST_CASE("where no dual has the topology of the surface, edges of the input are collapsed") {
  RemeshOptions options;
  options.count = 150;
  options.rounds = 1;
  // Two plates that cross each other, 10^-8 thick: their cells extend to the other sides.
  TriangleMesh plates = plate(1e-8);
  const std::vector<double> flat = plates.vertices;
  for (std::size_t k = 0; k < flat.size(); k += 3)
    plates.vertices.insert(plates.vertices.end(), {flat[k], 0.5 + flat[k + 2], flat[k + 1] - 0.4});
  const std::vector<std::uint32_t> one = plates.triangles;
  for (const std::uint32_t v : one) plates.triangles.push_back(v + 8);
  options.repair = false;
  const RemeshResult result = remesh(plates.vertices, plates.triangles, options);
  const MeshQuality quality = mesh_quality(result.mesh.vertices, result.mesh.triangles);
  CHECK(result.collapsed);
  REQUIRE(result.inseparable);
  CHECK(quality.vertices == options.count);
  CHECK(quality.manifold);
  CHECK(quality.euler_characteristic == 4);
  CHECK(quality.boundary_loops == 0);
  CHECK(farthest_from(result.mesh, plates, 20000) < 1e-7);
  CHECK(farthest_from(plates, result.mesh, 20000) < 1e-7);
  CHECK(result.intersections.count > 0);
  CHECK(std::fabs(result.intersections.first[1] - 0.5) < 0.2);
}

TEST_CASE("a cell around a tube gets points on a loop, a disc none") {
  const Surface surface = surface_from(tube());
  LocalDiagram diagram(surface);
  const Place from{0, (surface.corner(0, 0) + surface.corner(0, 1) + surface.corner(0, 2)) * (1.0 / 3)};
  diagram.insert(from.at, 0, 1);
  const std::vector<Place> around = points_around(diagram, 0, from);
  REQUIRE(around.size() == 2);
  for (const Place& place : around) {
    const double turn = std::remainder(angle_of(place) - angle_of(from), 2 * std::numbers::pi);
    CHECK(std::fabs(std::fabs(turn) - 2 * std::numbers::pi / 3) < 0.2);
    CHECK(std::fabs(place.at.z - from.at.z) < 0.2);
  }
  // Two cells of half the tube each share two walls; the loop passes through the sides.
  diagram.insert({-from.at.x, -from.at.y, from.at.z}, 0, 1);
  CHECK(points_around(diagram, 0, from).empty());
  const Place side = point_between(diagram, 0, 1, from);
  REQUIRE(side.triangle != nothing);
  CHECK(std::fabs(std::fabs(std::remainder(angle_of(side) - angle_of(from), 2 * std::numbers::pi)) -
                  std::numbers::pi / 2) < 0.2);
}

TEST_CASE("a seed added between others has a cell, whatever their weights") {
  const Surface surface = surface_from(tube());
  // With a gradation of 10, seeds with the weights of the sizing would hide each other.
  Sizing sizing{std::vector<double>(surface.vertex.size()), 10};
  for (std::size_t v = 0; v < sizing.h.size(); ++v) sizing.h[v] = 1 + 10 * std::fabs(surface.vertex[v].z);
  Sampling sampling(surface, sizing, {}, 1);
  const auto centre = [&](std::uint32_t t) {
    return Place{t, (surface.corner(t, 0) + surface.corner(t, 1) + surface.corner(t, 2)) * (1.0 / 3)};
  };
  const auto last = static_cast<std::uint32_t>(surface.size() - 1);
  std::uint32_t hidden = 0;
  for (const std::uint32_t t : {0u, last / 2, last}) sampling.add_free(centre(t));
  for (std::uint32_t i = 0; i < 3; ++i)
    if (sampling.owner(sampling.hold(i).place) != i) {
      ++hidden;
      CHECK(sampling.give_cell(i));
    }
  CHECK(hidden > 0);
  for (const std::uint32_t t : {last / 4, last / 3, last / 3 * 2}) {
    const std::uint32_t id = sampling.add_between(centre(t));
    CHECK(sampling.owner(centre(t)) == id);
  }
}

}  // namespace powercell::test
