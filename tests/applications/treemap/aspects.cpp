// The aspect ratio of cells, also for extremely thin ones.
#include <doctest/doctest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "lib/applications/treemap/convex_polygon.hpp"

using namespace powercell;
using treemap_detail::aspect;
using treemap_detail::moments;

namespace {

/// A rectangle rotated by an angle.
std::vector<double> rectangle(double length, double width, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  std::vector<double> corners;
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {length, 0.0}, {length, width}, {0.0, width}})
    corners.insert(corners.end(), {3 + c * x - s * y, 2 + s * x + c * y});
  return corners;
}

}  // namespace

TEST_CASE("aspects of rectangles of any width and rotation are right") {
  for (const double angle : {0.0, 0.3, 0.785, 2.0})
    for (const double ratio : {1.0, 2.0, 1e3, 1e6, 1e9}) {
      CAPTURE(angle);
      CAPTURE(ratio);
      CHECK(aspect(moments(rectangle(1, 1 / ratio, angle))) == doctest::Approx(ratio).epsilon(0.2));
    }
  CHECK(aspect(moments(rectangle(1, 1e-3, 0.3))) == doctest::Approx(1e3).epsilon(1e-6));
  CHECK(aspect(moments(rectangle(1e60, 1e51, 0.3))) == doctest::Approx(1e9).epsilon(0.2));
  CHECK(aspect(moments(std::vector<double>{0, 0, 1, 0, 0.5, std::sqrt(0.75)})) == doctest::Approx(1));
}
