#include "lib/applications/remeshing/frame.hpp"

#include <algorithm>
#include <limits>

namespace powercell::remeshing {

Frame frame_of(std::span<const double> vertices, std::span<const std::uint32_t> triangles) {
  constexpr double most = std::numeric_limits<double>::max();
  std::array<double, 3> low{most, most, most}, high{-most, -most, -most};
  for (const std::uint32_t v : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], vertices[3 * std::size_t{v} + k]);
      high[k] = std::max(high[k], vertices[3 * std::size_t{v} + k]);
    }
  const Vec a{low[0], low[1], low[2]}, b{high[0], high[1], high[2]};
  const double length = norm(b - a);
  return {(a + b) * 0.5, length > 0 ? std::exp2(std::ceil(std::log2(length))) : 1};
}

std::vector<double> Frame::to(std::span<const double> vertices) const {
  const double shift[3] = {centre.x, centre.y, centre.z};
  std::vector<double> result(vertices.begin(), vertices.end());
  for (std::size_t k = 0; k < result.size(); ++k) result[k] = (result[k] - shift[k % 3]) / length;
  return result;
}

}  // namespace powercell::remeshing
