#include "apps/io/picture_discs.hpp"

#include <algorithm>
#include <cmath>

namespace powercell::io {

double disc_magnification(const SeedsView& seeds, double spacing) {
  std::vector<double> radii;
  for (const double w : seeds.weights) {
    if (w != 0) radii.push_back(std::sqrt(std::abs(w)));
  }
  if (radii.empty() || !(spacing > 0)) return 1;
  const auto large = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() * 9 / 10);
  std::nth_element(radii.begin(), large, radii.end());
  const double relative = *large / spacing;
  return relative > 0.12 && relative < 1.0 ? 1 : 0.45 / relative;
}

std::vector<Scene::Disc> make_discs(const DiagramOutput& output, const Placement& placement, double width,
                                    double height, double spacing, double magnification) {
  std::vector<Scene::Disc> weights, dots, without_cell;
  const double dot = std::clamp(0.045 * spacing * placement.scale, 0.8, 3.2);
  for (std::size_t i = 0; i < output.seeds.size(); ++i) {
    const double x = placement.x(output.seeds.positions[2 * i]);
    const double y = placement.y(output.seeds.positions[2 * i + 1]);
    if (!(x >= 0 && x <= width && y >= 0 && y <= height)) continue;
    const auto seed = static_cast<std::uint32_t>(i);
    const SeedStatus status = output.measures.status[i];
    if (status == SeedStatus::hidden) without_cell.push_back({Scene::Mark::hidden, seed, x, y, 1.35 * dot});
    if (status == SeedStatus::duplicate) {
      without_cell.push_back({Scene::Mark::duplicate, seed, x, y, 1.9 * dot});
    }
    if (status != SeedStatus::ok) continue;
    dots.push_back({Scene::Mark::dot, seed, x, y, dot});
    if (!output.weights_as_discs || output.seeds.weights.empty()) continue;
    const double w = output.seeds.weights[i];
    const double radius = std::sqrt(std::abs(w)) * magnification * placement.scale;
    if (radius < 1.3 * dot) continue;
    weights.push_back({w > 0 ? Scene::Mark::positive : Scene::Mark::negative, seed, x, y, radius});
  }
  std::stable_sort(weights.begin(), weights.end(),
                   [](const Scene::Disc& a, const Scene::Disc& b) { return a.radius > b.radius; });
  weights.insert(weights.end(), dots.begin(), dots.end());
  weights.insert(weights.end(), without_cell.begin(), without_cell.end());
  return weights;
}

}  // namespace powercell::io
