// Derivatives of the measures with respect to the weights: from the walls (15) and by finite differences.
#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <powercell/diagram.hpp>

#include "lib/domain/region_mesh.hpp"
#include "tests/laws/cases.hpp"
#include "tests/support/polytope.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

Vec point(const std::vector<double>& values, int d, std::size_t i) {
  const double* x = &values[i * static_cast<std::size_t>(d)];
  return {x[0], x[1], d == 3 ? x[2] : 0.0};
}

/// (15): dm_i/dw_j = -a_ij / (2 |p_i - p_j|) for j != i, in the plane and in space.
std::map<std::pair<std::size_t, std::size_t>, double> from_walls(Diagram& diagram, const SeedArray& seeds) {
  std::map<std::pair<std::size_t, std::size_t>, double> derivative;
  const Adjacency& a = diagram.adjacency();
  for (std::size_t i = 0; i < seeds.size(); ++i)
    for (std::uint64_t k = a.offset[i]; k < a.offset[i + 1]; ++k) {
      const Vec q =
          point(seeds.positions, seeds.dimension, a.neighbor[k]) - point(seeds.positions, seeds.dimension, i);
      derivative[{i, a.neighbor[k]}] = -a.wall[k] / (2 * static_cast<double>(length(q)));
    }
  return derivative;
}

/// The same on a surface, where a wall crosses many triangles, and moves in each at a speed that depends on
/// the component of p_j - p_i in the triangle's plane.
std::map<std::pair<std::size_t, std::size_t>, double> from_edges(Diagram& diagram, const SeedArray& seeds) {
  std::map<std::pair<std::size_t, std::size_t>, double> derivative;
  const RegionMesh& mesh = diagram.domain().mesh();
  const Cells& c = diagram.cells();
  for (std::size_t i = 0; i < c.cell_count(); ++i)
    for (std::uint64_t p = c.cell_offset[i]; p < c.cell_offset[i + 1]; ++p) {
      const std::uint32_t* corner = &mesh.region_vertex[mesh.region_offset[c.region[p]]];
      const Vec origin = point(mesh.vertices, 3, corner[0]);
      Vec normal =
          cross(point(mesh.vertices, 3, corner[1]) - origin, point(mesh.vertices, 3, corner[2]) - origin);
      normal = (1 / length(normal)) * normal;
      const std::uint64_t first = c.vertex_offset[p], count = c.vertex_offset[p + 1] - first;
      for (std::uint64_t k = 0; k < count; ++k) {
        const Border& border = c.border[c.face_offset[p] + k];
        if (border.kind != Border::Kind::wall) continue;
        const Vec q = point(seeds.positions, 3, border.index) - point(seeds.positions, 3, i);
        const Real in_plane = length(q - dot(q, normal) * normal);
        const Real edge =
            length(point(c.vertices, 3, first + (k + 1) % count) - point(c.vertices, 3, first + k));
        derivative[{i, border.index}] -= static_cast<double>(edge / (2 * in_plane));
      }
    }
  return derivative;
}

void check_derivatives(const Case& one, const Setup& setup) {
  Diagram diagram(setup.device, one.domain, setup.options);
  diagram.set_seeds(one.seeds.view());
  const bool surface = one.domain.kind() == DomainKind::surface;
  const auto derivative = surface ? from_edges(diagram, one.seeds) : from_walls(diagram, one.seeds);
  REQUIRE_FALSE(derivative.empty());
  const double h = spacing(one.domain.measure(), one.seeds.size(), one.domain.cell_dimension());
  const double step = 1e-5 * h * h;
  const double unit = std::pow(h, one.domain.cell_dimension() - 2);  // size of a derivative
  for (std::size_t j = 0; j < one.seeds.size(); j += 7) {
    std::vector<double> weights = one.seeds.weights;
    weights[j] += step;
    diagram.set_weights(weights);
    const std::vector<double> up = diagram.measures().mass;
    weights[j] -= 2 * step;
    diagram.set_weights(weights);
    const std::vector<double> down = diagram.measures().mass;
    double own = 0;
    for (std::size_t i = 0; i < one.seeds.size(); ++i) {
      if (i == j) continue;
      const auto found = derivative.find({i, j});
      const double expected = found == derivative.end() ? 0 : found->second;
      own -= expected;
      CHECK(std::abs((up[i] - down[i]) / (2 * step) - expected) <= 1e-3 * unit + 1e-3 * std::abs(expected));
    }
    CHECK(std::abs((up[j] - down[j]) / (2 * step) - own) <= 1e-3 * unit + 1e-3 * own);
  }
}

}  // namespace

TEST_CASE("derivatives of the measures with respect to the weights follow from the walls") {
  INFO(replay_hint());
  for (const WeightRange range : {WeightRange::W0, WeightRange::W1})
    for (const Case& one : cases(100, range))
      for (const Setup& setup : all_setups()) {
        if (setup.options.precision != Precision::float64)
          continue;  // a difference quotient loses half of the digits
        INFO(one.name << ' ' << name(range) << ", " << setup.name);
        check_derivatives(one, setup);
      }
}
