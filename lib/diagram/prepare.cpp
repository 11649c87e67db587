// The kernels of a kind of diagram, built before they are needed: a few small diagrams that take each way
// through the pipeline.
#include <cmath>
#include <powercell/diagram.hpp>
#include <powercell/regions.hpp>

#include "lib/base/float_environment.hpp"
#include "lib/base/random.hpp"

namespace powercell {
namespace {

struct Seeds {
  int dimension;
  std::vector<double> positions, weights;

  SeedsView view() const { return {dimension, positions, weights}; }
};

class Trial {
 public:
  explicit Trial(const Domain& domain) : domain_(domain), d_(static_cast<std::size_t>(domain.dimension())) {}

  /// Uniform in the bounding box, with weights of up to `most` times the squared spacing.
  Seeds random(std::size_t count, double most) const {
    Seeds seeds{domain_.dimension(), {}, {}};
    const auto low = domain_.low(), high = domain_.high();
    double extent = 0;
    for (std::size_t k = 0; k < d_; ++k) extent = std::max(extent, high[k] - low[k]);
    const double spacing = extent / std::pow(static_cast<double>(count), 1 / static_cast<double>(d_));
    std::uint64_t state = 1;
    const auto unit = [&state] { return unit_from_bits(mixed_bits(state++)); };
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < d_; ++k) seeds.positions.push_back(low[k] + unit() * (high[k] - low[k]));
      seeds.weights.push_back(unit() * most * spacing * spacing);
    }
    return seeds;
  }

  /// Adds a seed within a region and more around it than a cell of the smallest capacity has faces.
  void add_cell_of_many_faces(Seeds& seeds) const {
    const RegionsView regions = domain_.regions();
    if (regions.size() == 0) return;
    const std::size_t first = regions.region_offset[0], corners = regions.region_offset[1] - first;
    const auto corner = [&](std::size_t c, std::size_t k) {
      return regions.vertices[regions.region_vertex[first + c] * d_ + k];
    };
    std::vector<double> center(d_);
    for (std::size_t k = 0; k < d_; ++k)
      for (std::size_t c = 0; c < corners; ++c) center[k] += corner(c, k) / static_cast<double>(corners);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < corners; ++c) {
      double squared = 0;
      for (std::size_t k = 0; k < d_; ++k) squared += std::pow(corner(c, k) - center[k], 2);
      nearest = std::min(nearest, std::sqrt(squared));
    }
    constexpr int around = 100;
    const double heaviest =
        seeds.weights.empty() ? 0 : *std::max_element(seeds.weights.begin(), seeds.weights.end());
    for (int i = -1; i < around; ++i) {
      const double z = 1 - (2 * i + 1) / static_cast<double>(around), angle = 2.399963229728653 * i;
      const double r = d_ == 2 ? 1 : std::sqrt(std::max(0.0, 1 - z * z));
      const double turn = d_ == 2 ? 6.283185307179586 * i / around : angle;
      const double at[] = {r * std::cos(turn), r * std::sin(turn), z};
      // Not all at one distance, which would be a tie of all planes.
      const double away =
          i < 0 ? 0 : nearest / 50 * (1 + 1e-3 * unit_from_bits(mixed_bits(static_cast<std::uint64_t>(i))));
      for (std::size_t k = 0; k < d_; ++k) seeds.positions.push_back(center[k] + away * at[k]);
      seeds.weights.push_back(heaviest);
    }
  }

 private:
  const Domain& domain_;
  const std::size_t d_;
};

}  // namespace

void prepare(const Device& device, const Domain& domain, const Options& options) {
  const FloatEnvironment environment;
  const Trial trial(domain);
  // Of few pairs only the first capacity is compiled; of many light seeds those that are hidden are set aside
  // first.
  Seeds many = trial.random(6000, 1);
  trial.add_cell_of_many_faces(many);
  const Seeds all[] = {trial.random(64, 0), std::move(many), trial.random(6000, 30)};
  double done = 0;
  Options part = options;
  if (options.progress)
    part.progress = [&](double fraction) { return options.progress((done + fraction) / std::size(all)); };
  Diagram diagram(device, domain, part);
  for (const Seeds& seeds : all) {
    diagram.set_seeds(seeds.view());
    diagram.compute(true, true);
    ++done;
  }
}

}  // namespace powercell
