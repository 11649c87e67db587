#include "lib/applications/transport/soft_start.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "lib/applications/transport/assignment.hpp"
#include "lib/applications/transport/seed_levels.hpp"
#include "lib/base/threads.hpp"

namespace powercell {
namespace {

constexpr std::size_t points_per_seed = 4, least_points = 500;
// Terms of (31e) that are taken: exp(-7) is negligible while the entropy decreases. In the end, the weights
// of near seeds must be a convex function to the last digit, as else cells are empty.
constexpr double few_terms = 7, all_terms = 36;
constexpr int sweeps = 4;  // at each temperature
constexpr double cooling = 2;
constexpr int most_coolings = 60;  // of a level: seeds at nearly one position stay shared
// Mean entropy of the shares of the seeds in a point at which a level ends.
constexpr double resolved_clusters = 0.7, resolved_seeds = 0.4;

void place_about(std::vector<double>& positions, const std::vector<double>& mean, double scale) {
  for (std::size_t k = 0; k < positions.size(); ++k)
    positions[k] = (positions[k] - mean[k % mean.size()]) * scale;
}

}  // namespace

SoftStart::Spread SoftStart::spread_of(std::span<const Weighted> all, std::size_t d) {
  Spread result{std::vector<double>(d), 0};
  double mass = 0;
  const auto each = [&](const auto& body) {
    for (const Weighted& some : all)
      for (std::size_t k = 0; k < some.positions.size(); ++k)
        body(k % d, some.positions[k], some.mass[k / d]);
  };
  for (const Weighted& some : all) mass += std::accumulate(some.mass.begin(), some.mass.end(), 0.0);
  each([&](std::size_t c, double x, double m) { result.mean[c] += m / mass * x; });
  each([&](std::size_t c, double x, double m) {
    result.deviation += m / mass * (x - result.mean[c]) * (x - result.mean[c]);
  });
  result.deviation = std::sqrt(result.deviation);
  return result;
}

SoftStart::SoftStart(std::size_t d, Points points, std::span<const double> positions,
                     std::span<const double> mass, int threads)
    : d_(d),
      threads_(thread_count(threads)),
      give_points_(std::move(points)),
      positions_(positions),
      of_domain_(spread_of(give_points_(least_points), d)) {
  Weighted seeds{
      {positions.begin(), positions.end()}, {mass.begin(), mass.end()}, std::vector<double>(mass.size())};
  const Spread of_seeds = spread_of({&seeds, 1}, d_);
  scale_ = of_seeds.deviation > 0 ? of_domain_.deviation / of_seeds.deviation : 1;
  place_about(seeds.positions, of_seeds.mean, scale_);
  levels_ = seed_levels(std::move(seeds), d_);
  heat_ = 2 * of_domain_.deviation * of_domain_.deviation;
}

void SoftStart::solve() {
  for (std::size_t l = levels_.size(); l-- > 0;) {
    Weighted& level = levels_[l];
    set_points(level.size());
    if (l + 1 < levels_.size()) {
      to_points(levels_[l + 1]);
      to_seeds(level, false);
    }
    cool(level, l == 0 ? resolved_seeds : resolved_clusters);
  }
  to_points(levels_[0]);
  to_seeds(levels_[0], true);
}

Vector SoftStart::weights() const {
  const Weighted& seeds = levels_[0];
  Vector weights(static_cast<Eigen::Index>(seeds.size()));
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    double moved = 0, given = 0;
    for (std::size_t c = 0; c < d_; ++c) {
      const double y = seeds.positions[i * d_ + c], p = positions_[i * d_ + c] - of_domain_.mean[c];
      moved += y * y;
      given += p * p;
    }
    weights[static_cast<Eigen::Index>(i)] = given - (moved - seeds.weights[i]) / scale_;
  }
  return weights;
}

void SoftStart::set_points(std::size_t seeds) {
  points_ = give_points_(std::max(least_points, points_per_seed * seeds));
  room_.clear();
  for (Weighted& part : points_) {
    part.weights.assign(part.size(), 0);
    place_about(part.positions, of_domain_.mean, 1);
    room_.push_back(std::accumulate(part.mass.begin(), part.mass.end(), 0.0));
  }
  const double sum = std::accumulate(room_.begin(), room_.end(), 0.0);
  for (double& share : room_) share /= sum;
}

void SoftStart::cool(Weighted& level, double resolved) {
  for (int k = 0; k < most_coolings; ++k) {
    double entropy = 0;
    for (int s = 1; s <= sweeps; ++s) {
      entropy = to_points(level);
      to_seeds(level, s == sweeps);
    }
    if (entropy < resolved) break;
    heat_ /= cooling;
  }
}

double SoftStart::to_points(const Weighted& seeds) {
  double entropy = 0;
  for (std::size_t p = 0; p < points_.size(); ++p)
    entropy += room_[p] * soften(seeds, points_[p], d_, heat_, threads_, few_terms);
  return entropy;
}

/// \param balanced  with prices of the parts for which each part gets its mass
void SoftStart::to_seeds(Weighted& seeds, bool balanced) {
  std::vector<std::vector<double>> gain;  // per part
  for (const Weighted& part : points_) {
    soften(part, seeds, d_, heat_, threads_, balanced && &seeds == &levels_[0] ? all_terms : few_terms);
    gain.push_back(seeds.weights);
    for (double& g : gain.back()) g = -g;
  }
  const std::vector<double> price = balanced ? prices(gain, seeds.mass) : std::vector<double>(points_.size());
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    double most = -std::numeric_limits<double>::infinity(), sum = 0;
    for (std::size_t p = 0; p < gain.size(); ++p) most = std::max(most, gain[p][i] - price[p]);
    for (std::size_t p = 0; p < gain.size(); ++p)
      sum += room_[p] * std::exp((gain[p][i] - price[p] - most) / heat_);
    seeds.weights[i] = -most - (balanced ? 0 : heat_ * std::log(sum));
  }
}

std::vector<double> SoftStart::prices(const std::vector<std::vector<double>>& gain,
                                      const std::vector<double>& mass) {
  const double total = std::accumulate(mass.begin(), mass.end(), 0.0);
  std::vector<double> room = room_;
  for (double& m : room) m *= total;
  Assignment assignment(gain, mass, room);
  std::vector<double> result = assignment.prices();
  shares_.clear();
  for (std::uint32_t p = 0; p < points_.size(); ++p)
    for (std::uint32_t i = 0; i < mass.size(); ++i)
      if (assignment.share()[p][i] > 0) shares_.push_back({p, i, assignment.share()[p][i]});
  return result;
}

}  // namespace powercell
