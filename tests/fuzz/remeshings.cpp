// New meshes of any triangles: the number of vertices asked for, the topology of the repaired input.
#include <cmath>
#include <powercell/remeshing.hpp>
#include <powercell/repair.hpp>
#include <string>

#include "tests/fuzz/laws.hpp"
#include "tests/fuzz/refusals.hpp"

namespace powercell::fuzz {
namespace {

/// A grid of squares in two triangles each, with any heights: a manifold unless numbers say otherwise.
TriangleMesh height_field(Input& input) {
  const auto side = static_cast<std::uint32_t>(2 + input.below(4));
  TriangleMesh mesh;
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      mesh.vertices.insert(mesh.vertices.end(), {static_cast<double>(x), static_cast<double>(y)});
      mesh.vertices.push_back(input.number());
    }
  for (std::uint32_t y = 0; y + 1 < side; ++y)
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      const std::uint32_t a = y * side + x, b = a + 1, c = a + side, d = c + 1;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, c, b, d, c});
    }
  return mesh;
}

TriangleMesh any_mesh(Input& input) {
  switch (input.below(4)) {
    case 0:
      return height_field(input);
    case 1: {  // an octahedron pulled about
      TriangleMesh mesh{{1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1},
                        {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5}};
      for (std::size_t moves = input.below(6); moves > 0; --moves)
        mesh.vertices[input.below(mesh.vertices.size())] = input.number();
      return mesh;
    }
    case 2:
      return input.flag() ? sphere(1 + static_cast<int>(input.below(2)))
                          : torus(3 + static_cast<int>(input.below(3)));
    default: {
      TriangleMesh mesh;
      const std::size_t vertices = input.below(10), triangles = input.below(12);
      mesh.vertices = input.numbers(3 * vertices + (input.below(32) == 31 ? 1 : 0));
      for (std::size_t k = 0; k < 3 * triangles + (input.below(32) == 31 ? 1 : 0); ++k)
        mesh.triangles.push_back(static_cast<std::uint32_t>(input.below(vertices + 1)));
      return mesh;
    }
  }
}

RemeshOptions any_remesh_options(Input& input) {
  RemeshOptions options;
  options.count = input.below(80);
  options.method = input.below(16) == 15 ? RemeshMethod::transport : RemeshMethod::farthest_point;
  options.rounds = static_cast<int>(input.below(4));
  options.relaxations = static_cast<int>(input.below(4));
  options.random_seed = input.byte();
  options.device = shared_device();
  if (input.below(4) == 3) options.sharp_angle = input.byte();
  if (input.below(4) == 3) options.contrast = 1 + input.byte() / 16.0;
  if (input.below(16) == 15) {
    options.gradation = input.number();
    options.contrast = input.number();
    options.sharp_angle = input.number();
    options.rounds = static_cast<int>(input.below(6)) - 2;
  }
  options.repair = input.below(4) != 3;
  return options;
}

void check(const RemeshResult& result, const MeshQuality& before, std::size_t count) {
  require(result.mesh.vertices.size() == 3 * count, "another number of vertices than asked for");
  for (const double x : result.mesh.vertices) require(std::isfinite(x), "a vertex that is not finite");
  const MeshQuality after = mesh_quality(result.mesh.vertices, result.mesh.triangles);
  require(after.manifold, "no manifold came out");
  // Without repair the input may be oriented inconsistently, for which these figures say nothing.
  require(!before.manifold || (after.euler_characteristic == before.euler_characteristic &&
                               after.boundary_loops == before.boundary_loops),
          "the topology has changed: Euler characteristic " + std::to_string(before.euler_characteristic) +
              " to " + std::to_string(after.euler_characteristic));
}

}  // namespace

void remeshings(Bytes bytes) {
  Input input(bytes);
  const TriangleMesh mesh = any_mesh(input);
  const RemeshOptions options = any_remesh_options(input);
  accepted({ErrorCode::invalid_argument, ErrorCode::invalid_domain, ErrorCode::not_converged,
            ErrorCode::unsupported},
           [&] {
             TriangleMesh input_mesh = mesh;
             if (options.repair) input_mesh = repair(mesh.vertices, mesh.triangles).mesh;
             const MeshQuality before = mesh_quality(input_mesh.vertices, input_mesh.triangles);
             const RemeshResult result = remesh(mesh.vertices, mesh.triangles, options);
             check(result, before, options.count);
             const double distance = farthest_from(result.mesh, mesh, 100);
             require(distance >= 0, "a distance that is negative or no number");
           });
}

}  // namespace powercell::fuzz
