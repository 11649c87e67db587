#include "lib/applications/periodic/periodic_diagram.hpp"

#include <algorithm>
#include <cmath>

namespace powercell {
namespace {

/// The box extended by half its size to each side, which contains all cells of seeds in the box.
Domain extended(const Domain& box) {
  if (box.kind() != DomainKind::polygon || box.region_count() != 1 ||
      box.measure() < (1 - 1e-12) * (box.high()[0] - box.low()[0]) * (box.high()[1] - box.low()[1]))
    throw Error(ErrorCode::unsupported, "only a box of the plane can be periodic");
  std::array<double, 2> low, high;
  for (std::size_t k = 0; k < 2; ++k) {
    const double half = (box.high()[k] - box.low()[k]) / 2;
    low[k] = box.low()[k] - half;
    high[k] = box.high()[k] + half;
  }
  return Domain::box(low, high);
}

/// Width of the first margin in mean spacings of the seeds. In single precision each cell must prove that it
/// is complete, which takes a wider margin.
double first_margin(Precision precision) {
  return precision == Precision::float64 ? 3 : 6;
}

}  // namespace

PeriodicDiagram::PeriodicDiagram(Device device, Domain box, const Options& options)
    : box_(std::move(box)),
      low_{box_.low()[0], box_.low()[1]},
      size_{box_.high()[0] - box_.low()[0], box_.high()[1] - box_.low()[1]},
      diagram_(std::move(device), extended(box_), options) {}

void PeriodicDiagram::set_seeds(std::span<const double> positions, std::span<const double> weights) {
  const std::size_t n = positions.size() / 2;
  if (positions.size() % 2 != 0 || (!weights.empty() && weights.size() != n))
    throw Error(ErrorCode::invalid_argument, std::to_string(positions.size()) + " coordinates and " +
                                                 std::to_string(weights.size()) + " weights for seeds");
  given_.assign(positions.begin(), positions.end());
  weights_.assign(weights.begin(), weights.end());
  weights_.resize(n);
  inside_ = inside(positions);
  if (margin_ == 0)
    margin_ = first_margin(diagram_.precision()) *
              std::sqrt(size_[0] * size_[1] / static_cast<double>(std::max<std::size_t>(n, 1))) /
              std::min(size_[0], size_[1]);
  margin_ = std::min(margin_, 1.0);
  copies_placed_ = weights_set_ = have_walls_ = false;
  measures_.reset();
}

std::vector<double> PeriodicDiagram::inside(std::span<const double> positions) const {
  std::vector<double> result(positions.begin(), positions.end());
  for (std::size_t k = 0; k < result.size(); ++k) {
    const double low = low_[k % 2], size = size_[k % 2];
    if (result[k] >= low && result[k] < low + size) continue;
    double rest = std::fmod(result[k] - low, size);  // exact, however many boxes away
    if (rest < 0) rest += size;
    result[k] = rest < size ? low + rest : low;
  }
  return result;
}

void PeriodicDiagram::set_weights(std::span<const double> weights) {
  if (weights.size() != weights_.size())
    throw Error(ErrorCode::invalid_argument, std::to_string(weights.size()) + " weights for " +
                                                 std::to_string(weights_.size()) + " seeds");
  weights_.assign(weights.begin(), weights.end());
  weights_set_ = have_walls_ = false;
  measures_.reset();
}

/// Lists the seeds first, then their copies in the margin.
void PeriodicDiagram::place_copies() {
  const std::size_t n = weights_.size();
  original_.clear();
  placed_.clear();
  for (std::uint32_t i = 0; i < n; ++i) {
    original_.push_back(i);
    placed_.push_back({inside_[2 * i], inside_[2 * i + 1]});
  }
  for (std::uint32_t i = 0; i < n; ++i)
    for (int a = -1; a <= 1; ++a)
      for (int b = -1; b <= 1; ++b) {
        if (a == 0 && b == 0) continue;
        const std::array<double, 2> at{inside_[2 * i] + a * size_[0], inside_[2 * i + 1] + b * size_[1]};
        bool near = true;
        for (std::size_t k = 0; k < 2; ++k)
          near = near && at[k] >= low_[k] - margin_ * size_[k] && at[k] <= low_[k] + (1 + margin_) * size_[k];
        if (!near) continue;
        original_.push_back(i);
        placed_.push_back(at);
      }
}

/// Missing copies can only enlarge cells, so the sum of the areas shows them, (34). In single precision
/// rounding may hide them.
bool PeriodicDiagram::has_enough_copies() const {
  if (margin_ >= 1) return true;
  if (diagram_.precision() == Precision::float32) return missing_copies_are_far();
  double sum = 0;
  const Measures& all = *measures_;
  for (std::size_t i = 0; i < weights_.size(); ++i) sum += all.mass[i];
  return std::abs(sum / box_.measure() - 1) <= 1e-12;
}

/// (34a): within the extent of each cell, (34b), its seed has a smaller power distance than even the heaviest
/// seed outside the margin could have.
bool PeriodicDiagram::missing_copies_are_far() const {
  constexpr double rounding = 1e-5;  // relative error of mean squared distances from the seed
  // Least area relative to that mean square: narrower cells may be artefacts of rounding.
  constexpr double narrowest = 1e-3;
  const double most = *std::max_element(weights_.begin(), weights_.end());
  const Measures& all = *measures_;
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    if (all.status[i] != SeedStatus::ok) continue;
    const double square = all.second_moment[i] / all.mass[i];
    if (!(all.mass[i] >= narrowest * square)) return false;
    const double x = all.centroid[2 * i], y = all.centroid[2 * i + 1];
    const double to_seed = std::hypot(x - placed_[i][0], y - placed_[i][1]);
    const double reach = std::sqrt(8 * (std::max(square - to_seed * to_seed, 0.0) + rounding * square));
    const double left = low_[0] - margin_ * size_[0], bottom = low_[1] - margin_ * size_[1];
    const double right = low_[0] + (1 + margin_) * size_[0], top = low_[1] + (1 + margin_) * size_[1];
    const double to_border = std::max(std::min({x - left, right - x, y - bottom, top - y}) - reach, 0.0);
    const double farthest = to_seed + reach;
    if (!(to_border * to_border - most >= farthest * farthest - weights_[i])) return false;
  }
  return true;
}

void PeriodicDiagram::compute(bool walls) {
  const std::size_t n = weights_.size();
  while (!measures_ || (walls && !have_walls_)) {
    if (!copies_placed_) place_copies();
    if (!copies_placed_ || !weights_set_) {
      std::vector<double> weights;
      for (const std::uint32_t i : original_) weights.push_back(weights_[i]);
      if (copies_placed_) {
        diagram_.set_weights(weights);
      } else {
        std::vector<double> positions;
        for (const auto& at : placed_) positions.insert(positions.end(), at.begin(), at.end());
        diagram_.set_seeds({2, positions, weights});
      }
      copies_placed_ = weights_set_ = true;
    }
    diagram_.compute(walls, false);
    measures_ = diagram_.measures();
    if (!has_enough_copies()) {
      margin_ = std::min(2 * margin_, 1.0);
      copies_placed_ = false;
      measures_.reset();
      continue;
    }
    if (walls) gather_walls();
    measures_->mass.resize(n);
    measures_->second_moment.resize(n);
    measures_->status.resize(n);
    measures_->centroid.resize(2 * n);
    measures_->domain_measure = box_.measure();
    for (std::size_t k = 0; k < 2 * n; ++k) measures_->centroid[k] += given_[k] - inside_[k];
  }
}

void PeriodicDiagram::gather_walls() {
  const std::size_t n = weights_.size();
  const Adjacency& all = diagram_.adjacency();
  wall_offset_.assign(1, 0);
  walls_.clear();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::uint64_t k = all.offset[i]; k < all.offset[i + 1]; ++k) {
      const std::uint32_t copy = all.neighbor[k];
      if (original_[copy] == i) continue;
      walls_.push_back({original_[copy],
                        all.wall[k],
                        {placed_[copy][0] - placed_[i][0], placed_[copy][1] - placed_[i][1]}});
    }
    wall_offset_.push_back(walls_.size());
  }
  have_walls_ = true;
}

const Measures& PeriodicDiagram::measures() {
  compute(false);
  return *measures_;
}

const std::vector<std::uint64_t>& PeriodicDiagram::wall_offset() {
  compute(true);
  return wall_offset_;
}

const std::vector<PeriodicDiagram::Wall>& PeriodicDiagram::walls() {
  compute(true);
  return walls_;
}

}  // namespace powercell
