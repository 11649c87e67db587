#include "tests/laws/cases.hpp"

namespace powercell::test {

namespace {

void move(SeedArray& points, const Motion& motion) {
  rotate(points, motion.angle, {0, 0, 0});
  scale(points, motion.scale);
  translate(points, motion.shift);
}

Ring moved(const Ring& ring, const Motion& motion) {
  SeedArray points{2, {}, {}};
  for (const auto& p : ring) points.push({p[0], p[1]}, 0);
  move(points, motion);
  Ring result;
  for (std::size_t i = 0; i < points.size(); ++i)
    result.push_back({points.coordinate(i, 0), points.coordinate(i, 1)});
  return result;
}

Parts moved(Parts parts, const Motion& motion) {
  for (PolygonPart& part : parts) {
    part.outer = moved(part.outer, motion);
    for (Ring& hole : part.holes) hole = moved(hole, motion);
  }
  return parts;
}

Mesh moved(Mesh mesh, const Motion& motion) {
  SeedArray points{3, mesh.vertices, std::vector<double>(mesh.vertex_count(), 0.0)};
  move(points, motion);
  mesh.vertices = points.positions;
  return mesh;
}

}  // namespace

std::vector<Case> cases(std::size_t n, WeightRange range, const Motion& motion) {
  Random shape(7), random(test_seed());
  const Mesh cube = cube_tetrahedra(2, 0.15, shape);
  std::vector<Case> list;
  // Seeds are drawn before the motion, so that every motion moves the same ones.
  const auto add = [&](const char* name, const Domain& rest, const Domain& there) {
    SeedArray seeds = seeds_for(rest, Distribution::white, range, n, random);
    move(seeds, motion);
    list.push_back({name, there, std::move(seeds)});
  };
  add("square_with_holes", Domain::polygon(square_with_holes()),
      Domain::polygon(moved(square_with_holes(), motion)));
  add("torus", surface_of(torus(16, 9)), surface_of(moved(torus(16, 9), motion)));
  add("cube_tetrahedra", volume_of(cube), volume_of(moved(cube, motion)));
  return list;
}

double partition_tolerance(Precision precision) {
  return precision == Precision::float32 ? 1e-5 : 1e-12;
}

}  // namespace powercell::test
