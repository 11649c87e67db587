// compare_remeshing: remeshes surfaces with powercell and with CGAL, checks the meshes with CGAL and prints a
// row of a table for each.
//
//   compare_remeshing COUNT [FILE.off ...]
//
// Without files it uses generated shapes: open and closed, smooth and with sharp edges.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <powercell/powercell.hpp>
#include <string>
#include <vector>

#include "apps/io/read/domain.hpp"
#include "bench/clocks.hpp"
#include "bench/remeshing/cgal_mesh.hpp"
#include "tests/applications/remeshing/shapes.hpp"

namespace {

using namespace powercell;

struct Shape {
  std::string name;
  TriangleMesh mesh;
};

std::vector<Shape> shapes(int count, char** files) {
  std::vector<Shape> list;
  for (int k = 0; k < count; ++k) {
    const io::LoadedDomain domain = io::read_domain(files[k], DomainKind::surface);
    list.push_back({std::filesystem::path(files[k]).stem().string(), {domain.vertices, domain.elements}});
  }
  if (!list.empty()) return list;
  for (const test::NamedMesh& shape : test::smooth_meshes()) list.push_back({shape.name, shape.mesh});
  list.push_back({"cube", test::cube_of_12()});
  list.push_back({"plate 0.05", test::plate(0.05)});
  return list;
}

double diagonal(const TriangleMesh& mesh) {
  const Domain domain = Domain::surface(mesh.vertices, mesh.triangles);
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += std::pow(domain.high()[k] - domain.low()[k], 2);
  return std::sqrt(sum);
}

/// Prints one row; returns whether the mesh is a manifold of the input's topology that does not intersect
/// itself.
bool print_row(const Shape& shape, const char* method, const TriangleMesh& mesh, double seconds) {
  const MeshQuality q = mesh_quality(mesh.vertices, mesh.triangles);
  const MeshQuality before = mesh_quality(shape.mesh.vertices, shape.mesh.triangles);
  const bench::MeshVerdict verdict = bench::check_by_cgal(shape.mesh, mesh);
  const double percent = 100 / diagonal(shape.mesh);
  const bool right = verdict.valid && !verdict.self_intersecting &&
                     verdict.euler == before.euler_characteristic &&
                     verdict.boundary_loops == before.boundary_loops;
  fmt::print("{:10} {:9} {:6} {:7.2f}  {:.3f} {:.3f} {:5.1f} {:7.3f} {:7.2f}  {:.3f} {:.3f}  {}\n",
             shape.name, method, q.vertices, seconds, q.q_min, q.q_mean, q.angle_min, 100 * q.below_30,
             100 * q.regular, percent * verdict.mesh_to_input, percent * verdict.input_to_mesh,
             right                       ? "ok"
             : !verdict.valid            ? "not a manifold"
             : verdict.self_intersecting ? "intersects itself"
                                         : "wrong topology");
  std::fflush(stdout);
  return right;
}

bool compare(const Shape& shape, std::size_t count) {
  bool right = true;
  for (const bool transport : {false, true}) {
    RemeshOptions options;
    options.count = count;
    options.method = transport ? RemeshMethod::transport : RemeshMethod::farthest_point;
    const double start = bench::processor_seconds();
    const RemeshResult result = remesh(shape.mesh.vertices, shape.mesh.triangles, options);
    const double seconds = bench::processor_seconds() - start;
    right &= print_row(shape, transport ? "transport" : "fpo", result.mesh, seconds);
  }
  double seconds = 0;
  for (const int iterations : {5, 20}) {
    const TriangleMesh peer = bench::remesh_by_cgal(shape.mesh, count, iterations, 45, seconds);
    print_row(shape, iterations == 5 ? "CGAL 5" : "CGAL 20", peer, seconds);
  }
  return right;
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t count = argc > 1 ? std::stoul(argv[1]) : 5000;
  fmt::print("{:10} {:9} {:>6} {:>7}  {:>5} {:>5} {:>5} {:>7} {:>7}  {:>5} {:>5}\n", "shape", "method",
             "points", "cpu s", "Q min", "mean", "angle", "<30 %", "5-7 %", "H to", "H from");
  bool right = true;
  try {
    for (const Shape& shape : shapes(argc - 2 > 0 ? argc - 2 : 0, argv + 2)) right &= compare(shape, count);
  } catch (const Error& error) {
    fmt::print(stderr, "compare_remeshing: error: {}\n", error.what());
    return 1;
  }
  return right ? 0 : 1;
}
