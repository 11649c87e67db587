#include <algorithm>
#include <cmath>
#include <limits>
#include <powercell/point_sets.hpp>

#include "lib/periodic/periodic_diagram.hpp"

namespace powercell {
namespace {

/// The largest distance that neighbours can all have, with cells of this measure.
double lattice_distance(double measure, int cell_dimension) {
  return cell_dimension == 2 ? std::sqrt(2 * measure / std::sqrt(3.0)) : std::cbrt(std::sqrt(2.0) * measure);
}

/// What neighbours say, point by point in order.
class Neighbours {
 public:
  explicit Neighbours(bool flat) : flat_(flat) {}

  void meet(const std::array<double, 3>& step) {
    const double distance2 = step[0] * step[0] + step[1] * step[1] + step[2] * step[2];
    nearest2_ = std::min(nearest2_, distance2);
    if (!flat_) return;
    const double angle = 6 * std::atan2(step[1], step[0]);
    re_ += std::cos(angle);
    im_ += std::sin(angle);
    ++count_;
  }
  /// \param largest  what the distance is taken over
  void finish_point(double largest) {
    const double distance = std::sqrt(nearest2_) / largest;
    least_ = std::min(least_, distance);
    sum_ += distance;
    if (count_ > 0) order_ += std::hypot(re_, im_) / static_cast<double>(count_);
    ++points_;
    nearest2_ = std::numeric_limits<double>::infinity();
    re_ = im_ = 0;
    count_ = 0;
  }
  Spacing result() const {
    const auto n = static_cast<double>(points_);
    return {least_, sum_ / n, flat_ ? order_ / n : std::numeric_limits<double>::quiet_NaN()};
  }

 private:
  bool flat_;
  double nearest2_ = std::numeric_limits<double>::infinity(), re_ = 0, im_ = 0;
  std::size_t count_ = 0, points_ = 0;
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

}  // namespace

Spacing spacing(const Device& device, const Domain& domain, std::span<const double> positions, bool periodic,
                bool uniform, const Options& options) {
  const auto d = static_cast<std::size_t>(domain.dimension());
  const int cell_dimension = domain.cell_dimension();
  const std::size_t n = positions.size() / d;
  Neighbours neighbours(d == 2);
  const auto largest = [&](double mass) {
    return lattice_distance(uniform ? domain.measure() / static_cast<double>(n) : mass, cell_dimension);
  };
  if (periodic) {
    PeriodicDiagram diagram(device, domain, options);
    diagram.set_seeds(positions, {});
    const std::vector<PeriodicDiagram::Wall>& walls = diagram.walls();
    const std::vector<std::uint64_t>& offset = diagram.wall_offset();
    require_cells(diagram.measures());
    for (std::size_t i = 0; i < n; ++i) {
      for (std::uint64_t k = offset[i]; k < offset[i + 1]; ++k)
        neighbours.meet({walls[k].step[0], walls[k].step[1], 0});
      neighbours.finish_point(largest(diagram.measures().mass[i]));
    }
    return neighbours.result();
  }
  Diagram diagram(device, domain, options);
  diagram.set_seeds({domain.dimension(), positions, {}});
  const Adjacency& adjacency = diagram.adjacency();
  require_cells(diagram.measures());
  for (std::size_t i = 0; i < n; ++i) {
    for (std::uint64_t k = adjacency.offset[i]; k < adjacency.offset[i + 1]; ++k) {
      std::array<double, 3> step{};
      for (std::size_t c = 0; c < d; ++c)
        step[c] = positions[adjacency.neighbor[k] * d + c] - positions[i * d + c];
      neighbours.meet(step);
    }
    neighbours.finish_point(largest(diagram.measures().mass[i]));
  }
  return neighbours.result();
}

}  // namespace powercell
