#include "lib/domain/solid_points.hpp"

#include <array>
#include <limits>
#include <powercell/error.hpp>

#include "lib/base/random.hpp"
#include "lib/domain/orientation.hpp"

namespace powercell {
namespace {

const double* corner(const RegionMesh& mesh, std::uint32_t triangle, std::size_t k) {
  return &mesh.vertices[3 * std::size_t{mesh.region_vertex[3 * std::size_t{triangle} + k]}];
}

std::vector<Box> boxes_of(const RegionMesh& mesh) {
  std::vector<Box> boxes(mesh.region_count());
  for (std::uint32_t t = 0; t < boxes.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) boxes[t].add(corner(mesh, t, k));
  return boxes;
}

}  // namespace

SolidPoints::SolidPoints(const RegionMesh& boundary)
    : mesh_(boundary), boxes_(boxes_of(boundary)), tree_(boxes_) {}

std::optional<bool> SolidPoints::contains(const double* point) const {
  Box line;
  line.add(point);
  line.high[0] = std::numeric_limits<double>::infinity();
  bool inside = false, unclear = false;
  tree_.for_each_meeting(line, [&](std::uint32_t t) {
    const std::array<const double*, 3> at{corner(mesh_, t, 0), corner(mesh_, t, 1), corner(mesh_, t, 2)};
    const int facing = orient2d(at[0] + 1, at[1] + 1, at[2] + 1);  // as seen along x
    bool left = false, right = false, on_edge = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const int side = orient2d(at[k] + 1, at[(k + 1) % 3] + 1, point + 1);
      left = left || side > 0;
      right = right || side < 0;
      on_edge = on_edge || side == 0;
    }
    if (left && right) return;
    const int beyond = facing * orient3d(at[0], at[1], at[2], point);
    if (on_edge || beyond == 0)
      unclear = true;
    else if (beyond < 0)
      inside = !inside;
  });
  if (unclear) return {};
  return inside;
}

std::vector<Sample> random_points_in_solid(const RegionMesh& mesh, std::size_t count,
                                           std::uint64_t random_seed) {
  constexpr double least_filling = 1e-6;
  double box = 1;
  for (std::size_t k = 0; k < 3; ++k) box *= mesh.high[k] - mesh.low[k];
  if (!(mesh.measure > least_filling * box))
    throw Error(ErrorCode::unsupported,
                "the solid fills less than a millionth of its bounding box: too little to draw points from");
  const SolidPoints solid(*mesh.solid_boundary);
  std::mt19937_64 engine(random_seed);
  std::vector<Sample> samples;
  while (samples.size() < count) {
    std::array<double, 3> x{};
    for (std::size_t k = 0; k < 3; ++k) x[k] = mesh.low[k] + (mesh.high[k] - mesh.low[k]) * uniform(engine);
    if (solid.contains(x.data()) == true) samples.push_back({0, {x[0], x[1], x[2]}});
  }
  return samples;
}

}  // namespace powercell
