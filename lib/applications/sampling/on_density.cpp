// Points where the density is positive.
#include <algorithm>
#include <cmath>
#include <limits>
#include <powercell/point_sets.hpp>

#include "lib/applications/density/model.hpp"
#include "lib/applications/sampling/even_points.hpp"
#include "lib/applications/sampling/state.hpp"

namespace powercell {
namespace {

using Place = std::array<double, 2>;

double squared_distance(const double* a, const double* b) {
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}

/// Random points of a density, to place points of cells at.
class Candidates {
 public:
  Candidates(std::vector<double> drawn, std::span<const double> seeds, std::span<const double> weights)
      : drawn_(std::move(drawn)), seeds_(seeds), weights_(weights) {}

  /// Those in a cell, by index.
  /// \param low, high  the box of the cell
  std::vector<std::size_t> in_cell(std::size_t cell, const Place& low, const Place& high) const {
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < drawn_.size() / 2; ++k) {
      const double* x = &drawn_[2 * k];
      if (x[0] < low[0] || x[0] > high[0] || x[1] < low[1] || x[1] > high[1]) continue;
      const double least = power(x, cell);
      bool best = true;
      for (std::size_t j = 0; j < weights_.size() && best; ++j) best = least <= power(x, j);
      if (best) found.push_back(k);
    }
    return found;
  }
  /// The one with the least sum of distances to the others: inside the heaviest part of a cell of several.
  std::size_t central(const std::vector<std::size_t>& among) const {
    std::size_t best = among.front();
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t i : among) {
      double sum = 0;
      for (const std::size_t j : among) sum += std::sqrt(squared_distance(&drawn_[2 * i], &drawn_[2 * j]));
      if (sum < least) {
        least = sum;
        best = i;
      }
    }
    return best;
  }
  std::size_t nearest(const double* x) const {
    std::size_t best = 0;
    for (std::size_t k = 1; k < drawn_.size() / 2; ++k)
      if (squared_distance(&drawn_[2 * k], x) < squared_distance(&drawn_[2 * best], x)) best = k;
    return best;
  }
  const double* at(std::size_t k) const { return &drawn_[2 * k]; }

 private:
  double power(const double* x, std::size_t i) const {
    return squared_distance(x, &seeds_[2 * i]) - weights_[i];
  }

  std::vector<double> drawn_;
  std::span<const double> seeds_, weights_;
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
  const Cells& geometry = solver_.diagram().cells();
  for (const std::size_t i : bare) {
    Place low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    Place high{-low[0], -low[1]};
    for (std::uint64_t p = geometry.cell_offset[i]; p < geometry.cell_offset[i + 1]; ++p)
      for (std::uint64_t v = geometry.vertex_offset[p]; v < geometry.vertex_offset[p + 1]; ++v)
        for (std::size_t c = 0; c < 2; ++c) {
          low[c] = std::min(low[c], geometry.vertices[2 * v + c]);
          high[c] = std::max(high[c], geometry.vertices[2 * v + c]);
        }
    const std::vector<std::size_t> inside = candidates.in_cell(i, low, high);
    const std::size_t to =
        inside.empty() ? candidates.nearest(&positions[2 * i]) : candidates.central(inside);
    std::copy_n(candidates.at(to), 2, &positions[2 * i]);
  }
  return positions;
}

}  // namespace powercell
