#include "bench/box_cell.hpp"

#include <array>
#include <utility>
#include <vector>

namespace powercell::bench {

double cell_area_in_box(const SeedsView& seeds, std::size_t i, std::span<const std::uint32_t> neighbors,
                        const test::Box& box) {
  using Point = std::array<double, 2>;
  const double* p = &seeds.positions[2 * i];
  const double x0 = box.low[0] - p[0], x1 = box.high[0] - p[0], y0 = box.low[1] - p[1],
               y1 = box.high[1] - p[1];
  std::vector<Point> ring{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, kept;
  for (const std::uint32_t j : neighbors) {
    const double* other = &seeds.positions[2 * static_cast<std::size_t>(j)];
    const double qx = other[0] - p[0], qy = other[1] - p[1];
    const double offset = 0.5 * (qx * qx + qy * qy + seeds.weights[i] - seeds.weights[j]);
    const auto excess = [&](const Point& y) { return qx * y[0] + qy * y[1] - offset; };
    kept.clear();
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point &a = ring[k], &b = ring[k + 1 < ring.size() ? k + 1 : 0];
      const double ea = excess(a), eb = excess(b);
      if (ea <= 0) kept.push_back(a);
      if ((ea <= 0) != (eb <= 0)) {
        const double t = ea / (ea - eb);
        kept.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
      }
    }
    std::swap(ring, kept);
  }
  double twice = 0;
  for (std::size_t k = 2; k < ring.size(); ++k)
    twice += (ring[k - 1][0] - ring[0][0]) * (ring[k][1] - ring[0][1]) -
             (ring[k - 1][1] - ring[0][1]) * (ring[k][0] - ring[0][0]);
  return 0.5 * twice;
}

}  // namespace powercell::bench
