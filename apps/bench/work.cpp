#include "apps/bench/work.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace powercell::app {
namespace {

// Operations for each item that Work counts; d coordinates.
double for_near_seed(int d) {
  return 3 * d + 1;  // p_j - p_i: d; its square: 2d - 1; + w_i - w_j: 2
}
double for_corner_test(int d) {
  return 2 * d;  // q . y: 2d - 1; the comparison: 1
}
double for_corner(int d) {
  return 5 * d + 1;  // where on the edge: 2; the point: 3d; its distance from the seed: 2d - 1
}
double for_triangle(int d, int cell_dimension) {
  if (cell_dimension == 3) return 14 + 1 + 12 + 13;  // determinant, measure, centroid, second moment
  return d == 2 ? 3 + 1 + 6 + 10 : 14 + 1 + 9 + 16;  // on a surface the determinant is a length
}

double square_distance(const double* a, const double* b, int d) {
  double sum = 0;
  for (int k = 0; k < d; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

// The expected number of n white seeds within `radius` of a point, the seed there included. The ball is cut
// to the domain's box along each axis; a surface counts as flat.
double seeds_within(const Domain& domain, std::size_t n, const double* point, double radius) {
  using std::numbers::pi;
  const double ball =
      domain.cell_dimension() == 3 ? 4 * pi / 3 * radius * radius * radius : pi * radius * radius;
  double expected = static_cast<double>(n) * ball / domain.measure();
  if (domain.kind() != DomainKind::surface && radius > 0) {
    const auto low = domain.low(), high = domain.high();
    for (int k = 0; k < domain.dimension(); ++k) {
      const double inside = std::min(point[k] + radius, high[k]) - std::max(point[k] - radius, low[k]);
      expected *= std::clamp(inside / (2 * radius), 0.0, 1.0);
    }
  }
  return std::min(expected, static_cast<double>(n));
}

double corner_mean(const io::LoadedDomain& domain, std::size_t element, std::size_t corners) {
  double sum = 0;
  for (std::size_t k = 0; k < corners; ++k)
    sum += domain.vertices[3 * std::size_t{domain.elements[corners * element + k]} + 2];
  return sum / static_cast<double>(corners);
}

double element_measure(const io::LoadedDomain& domain, std::size_t element, std::size_t corners) {
  const std::uint32_t* v = domain.elements.data() + corners * element;
  const double* o = domain.vertices.data() + 3 * std::size_t{v[0]};
  double e[3][3] = {};
  for (std::size_t k = 1; k < corners; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      e[k - 1][axis] = domain.vertices[3 * std::size_t{v[k]} + axis] - o[axis];
  const double n[3] = {e[0][1] * e[1][2] - e[0][2] * e[1][1], e[0][2] * e[1][0] - e[0][0] * e[1][2],
                       e[0][0] * e[1][1] - e[0][1] * e[1][0]};
  if (corners == 3) return std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
  return std::abs(n[0] * e[2][0] + n[1] * e[2][1] + n[2] * e[2][2]) / 6;
}

}  // namespace

double Work::operations() const {
  return near * for_near_seed(dimension) + corner_tests * for_corner_test(dimension) +
         corners * for_corner(dimension) + triangles * for_triangle(dimension, cell_dimension);
}

double Work::bytes(std::size_t bytes_a_real) const {
  const auto real = static_cast<double>(bytes_a_real);
  // The seed and its place in the order; for each piece its (region, seed) pair, and its moments, which are
  // written and read again to be summed.
  return (dimension + 1) * real + 4 + pieces * (8 + 2 * (2 + dimension) * real);
}

Work count_work(const Domain& domain, const Cells& cells, std::span<const double> positions) {
  Work work{domain.dimension(), domain.cell_dimension()};
  const auto d = static_cast<std::size_t>(work.dimension);
  const std::size_t n = cells.cell_count();
  for (std::size_t i = 0; i < n; ++i) {
    const double* seed = positions.data() + d * i;
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p) {
      const auto corners = static_cast<double>(cells.vertex_offset[p + 1] - cells.vertex_offset[p]);
      double reach = 0;  // square of the distance to the farthest corner
      for (std::uint64_t v = cells.vertex_offset[p]; v < cells.vertex_offset[p + 1]; ++v)
        reach = std::max(reach, square_distance(&cells.vertices[d * v], seed, work.dimension));
      // Seeds farther away than twice that cannot cut the piece (mathematics, security radius).
      const double near = seeds_within(domain, n, seed, 2 * std::sqrt(reach));
      work.near += near;
      work.corner_tests += near * corners;
      work.corners += corners;
      if (work.cell_dimension == 2)
        work.triangles += corners - 2;
      else
        for (std::uint64_t f = cells.face_offset[p]; f < cells.face_offset[p + 1]; ++f)
          work.triangles += static_cast<double>(cells.loop_offset[f + 1] - cells.loop_offset[f]) - 2;
    }
  }
  work.pieces = static_cast<double>(cells.piece_count());
  for (double* sum : {&work.pieces, &work.corners, &work.triangles, &work.near, &work.corner_tests})
    *sum /= static_cast<double>(std::max<std::size_t>(n, 1));
  return work;
}

Domain part_of(const io::LoadedDomain& whole, double share) {
  if (share >= 1 || whole.domain.region_count() <= 1 || whole.elements.empty()) return whole.domain;
  const std::size_t corners = whole.domain.kind() == DomainKind::volume ? 4 : 3;
  std::vector<std::size_t> order(whole.elements.size() / corners);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<double> height(order.size());
  for (const std::size_t element : order) height[element] = corner_mean(whole, element, corners);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return height[a] < height[b]; });

  std::vector<std::uint32_t> kept;
  double measure = 0;
  for (const std::size_t element : order) {
    if (measure >= share * whole.domain.measure()) break;
    measure += element_measure(whole, element, corners);
    const auto first = whole.elements.begin() + static_cast<std::ptrdiff_t>(corners * element);
    kept.insert(kept.end(), first, first + static_cast<std::ptrdiff_t>(corners));
  }
  return corners == 4 ? Domain::volume(whole.vertices, kept) : Domain::surface(whole.vertices, kept);
}

}  // namespace powercell::app
