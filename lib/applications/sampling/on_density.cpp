// Points where the density is positive.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <powercell/point_sets.hpp>

#include "lib/applications/density/model.hpp"
#include "lib/applications/sampling/even_points.hpp"
#include "lib/applications/sampling/state.hpp"
#include "lib/applications/transport/power_tree.hpp"

namespace powercell {
namespace {

std::vector<std::uint32_t> indices(std::size_t count) {
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

/// Random points of a density in the plane, to place the points of cells at.
class Candidates {
 public:
  Candidates(std::vector<double> drawn, std::span<const double> seeds, std::span<const double> weights)
      : drawn_(std::move(drawn)), no_weights_(drawn_.size() / 2), in_cell_(weights.size()) {
    const PowerTree cells(seeds, weights, 2, indices(weights.size()));
    for (std::uint32_t k = 0; k < no_weights_.size(); ++k)
      in_cell_[cells.nearest({drawn_[2 * k], drawn_[2 * k + 1], 0}).seed].push_back(k);
  }

  /// The place for the point of a cell: a candidate in it, else the nearest one.
  const double* place(std::size_t cell, const double* point) const {
    const std::vector<std::uint32_t>& inside = in_cell_[cell];
    return at(inside.empty() ? tree_.nearest({point[0], point[1], 0}).seed : central(inside));
  }

 private:
  const double* at(std::uint32_t k) const { return &drawn_[2 * std::size_t{k}]; }

  /// The one with the least sum of distances to the others: inside the heaviest part of a cell of several.
  std::uint32_t central(const std::vector<std::uint32_t>& among) const {
    const auto sum = [&](std::uint32_t i) {
      double result = 0;
      for (const std::uint32_t j : among) result += std::hypot(at(i)[0] - at(j)[0], at(i)[1] - at(j)[1]);
      return result;
    };
    return *std::ranges::min_element(among, {}, sum);
  }

  std::vector<double> drawn_, no_weights_;
  std::vector<std::vector<std::uint32_t>> in_cell_;
  PowerTree tree_{drawn_, no_weights_, 2, indices(no_weights_.size())};
};

}  // namespace

std::vector<double> SamplingState::on_density(std::vector<double> positions) {
  if (domain_.kind() != DomainKind::polygon || options_.density.is_constant()) return positions;
  const std::unique_ptr<PointSource> source = options_.density.model().source(domain_);
  std::vector<std::size_t> bare;  // points where the density is 0
  for (std::size_t i = 0; i < size(); ++i) {
    const Point x{positions[2 * i], positions[2 * i + 1], 0};
    double value = 0;
    source->evaluate({&x, 1}, 0, {&value, 1});
    if (!(value > 0)) bare.push_back(i);
  }
  if (bare.empty()) return positions;
  const Candidates candidates(
      random_points(domain_, options_.density, points_to_choose_from * size(), options_.random_seed),
      positions_, cells().weights);
  for (const std::size_t i : bare) std::copy_n(candidates.place(i, &positions[2 * i]), 2, &positions[2 * i]);
  return positions;
}

}  // namespace powercell
