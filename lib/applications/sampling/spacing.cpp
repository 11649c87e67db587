#include "lib/applications/sampling/spacing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/applications/transport/periodic_domain.hpp"
#include "lib/base/float_environment.hpp"

namespace powercell {
namespace {

/// The distance of neighbours in the densest lattice with cells of this measure: hexagonal, or face-centred
/// cubic.
double lattice_distance(double measure, int cell_dimension) {
  return cell_dimension == 2 ? std::sqrt(2 * measure / std::sqrt(3.0)) : std::cbrt(std::sqrt(2.0) * measure);
}

/// Accumulates the statistics: add() for each neighbour of a point, then finish_point().
class Accumulator {
 public:
  explicit Accumulator(bool flat) : flat_(flat) {}

  /// \param step  from the point to its neighbour
  void add(const std::array<double, 3>& step) {
    const double distance2 = step[0] * step[0] + step[1] * step[1] + step[2] * step[2];
    nearest2_ = std::min(nearest2_, distance2);
    ++count_;
    if (!flat_) return;
    const double angle = 6 * std::atan2(step[1], step[0]);
    re_ += std::cos(angle);
    im_ += std::sin(angle);
  }
  /// \param unit  of the distance
  void finish_point(double unit) {
    ++points_;
    if (count_ == 0) return;
    const double distance = std::sqrt(nearest2_) / unit;
    least_ = std::min(least_, distance);
    sum_ += distance;
    order_ += std::hypot(re_, im_) / static_cast<double>(count_);
    ++with_neighbours_;
    neighbours_ += count_;
    nearest2_ = std::numeric_limits<double>::infinity();
    re_ = im_ = 0;
    count_ = 0;
  }
  NeighbourStatistics result() const {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    NeighbourStatistics result{{nan, nan, nan}, 0};
    if (with_neighbours_ == 0) return result;
    const auto n = static_cast<double>(with_neighbours_);
    result.spacing = {least_, sum_ / n, flat_ ? order_ / n : nan};
    result.neighbours = static_cast<double>(neighbours_) / static_cast<double>(points_);
    return result;
  }

 private:
  bool flat_;
  double nearest2_ = std::numeric_limits<double>::infinity(), re_ = 0, im_ = 0;
  std::size_t count_ = 0;  // neighbours of the current point
  std::size_t points_ = 0, with_neighbours_ = 0, neighbours_ = 0;
  double least_ = std::numeric_limits<double>::infinity(), sum_ = 0, order_ = 0;
};

void require_cells(const Measures& measures) {
  if (measures.mass.size() < 2)
    throw Error(ErrorCode::invalid_argument, "the spacing of points needs at least two of them");
  for (std::size_t i = 0; i < measures.status.size(); ++i)
    if (measures.status[i] != SeedStatus::ok)
      throw Error(ErrorCode::invalid_argument,
                  "point " + std::to_string(i) + " has no cell: it is outside the domain or given twice");
}

using Step = std::array<double, 3>;

/// Calls `check(measures)`, then accumulates the neighbours of all points that have a cell.
template <class Check>
NeighbourStatistics measure_neighbours(const Device& device, const Domain& domain,
                                       std::span<const double> positions, bool periodic, bool uniform,
                                       const Options& options, const Check& check) {
  Diagram diagram(device, periodic_domain(domain, periodic), options);
  diagram.set_seeds({domain.dimension(), positions, {}});
  const auto d = static_cast<std::size_t>(domain.dimension());
  const std::size_t n = positions.size() / d;
  const Adjacency& adjacency = diagram.adjacency();
  const Measures& measures = diagram.measures();
  check(measures);
  const auto periods = diagram.domain().periods();
  Accumulator statistics(d == 2);
  for (std::size_t i = 0; i < n; ++i) {
    if (measures.status[i] != SeedStatus::ok) continue;
    for (std::uint64_t k = adjacency.offset[i]; k < adjacency.offset[i + 1]; ++k) {
      Step step{};
      for (std::size_t c = 0; c < d; ++c) {
        step[c] = positions[adjacency.neighbor[k] * d + c] - positions[i * d + c];
        for (std::size_t axis = 0; axis < d && !adjacency.shift.empty(); ++axis)
          step[c] += adjacency.shift[k][axis] * periods[axis][c];
      }
      statistics.add(step);
    }
    const double measure = uniform ? domain.measure() / static_cast<double>(n) : measures.mass[i];
    statistics.finish_point(lattice_distance(measure, domain.cell_dimension()));
  }
  return statistics.result();
}

}  // namespace

NeighbourStatistics neighbour_statistics(const Device& device, const Domain& domain,
                                         std::span<const double> positions, bool periodic, bool uniform,
                                         const Options& options) {
  return measure_neighbours(device, domain, positions, periodic, uniform, options, [](const Measures&) {});
}

Spacing spacing(const Device& device, const Domain& domain, std::span<const double> positions, bool periodic,
                bool uniform, const Options& options) {
  const FloatEnvironment environment;
  return measure_neighbours(device, domain, positions, periodic, uniform, options, require_cells).spacing;
}

}  // namespace powercell
