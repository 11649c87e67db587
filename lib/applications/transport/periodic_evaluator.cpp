#include <algorithm>
#include <cmath>

#include "lib/applications/transport/evaluator.hpp"

namespace powercell {
namespace {

struct Entry {
  std::uint32_t seed;
  double wall, conductance;
};

/// Joins the walls of a seed with several copies of another into one entry.
std::vector<Entry> row_of(std::span<const PeriodicDiagram::Wall> walls) {
  std::vector<Entry> row;
  for (const PeriodicDiagram::Wall& wall : walls)
    row.push_back({wall.seed, wall.measure, wall.measure / (2 * std::hypot(wall.step[0], wall.step[1]))});
  std::sort(row.begin(), row.end(), [](const Entry& a, const Entry& b) { return a.seed < b.seed; });
  std::vector<Entry> joined;
  for (const Entry& entry : row) {
    if (joined.empty() || joined.back().seed != entry.seed) {
      joined.push_back(entry);
    } else {
      joined.back().wall += entry.wall;
      joined.back().conductance += entry.conductance;
    }
  }
  return joined;
}

/// Makes the rows symmetric: the two sides of a wall are computed from different copies, and the side of the
/// lower index gives the value for both.
void make_rows(const std::vector<std::vector<Entry>>& rows, double density, Iterate& at) {
  Adjacency& walls = at.cells.walls;
  walls.offset = {0};
  for (std::uint32_t i = 0; i < rows.size(); ++i) {
    for (const Entry& here : rows[i]) {
      const std::vector<Entry>& other = rows[here.seed];
      const auto back = std::lower_bound(other.begin(), other.end(), i,
                                         [](const Entry& entry, std::uint32_t j) { return entry.seed < j; });
      if (back == other.end() || back->seed != i) continue;  // a wall as short as rounding errors
      const Entry& taken = i < here.seed ? here : *back;
      walls.neighbor.push_back(here.seed);
      walls.wall.push_back(density * taken.wall);
      at.conductance.push_back(density * taken.conductance);
    }
    walls.offset.push_back(walls.neighbor.size());
  }
}

}  // namespace

PeriodicEvaluator::PeriodicEvaluator(Diagram& diagram, PeriodicDiagram& periodic, const Density& density,
                                     std::span<const double> positions, const Goal& goal, int threads)
    : Evaluator(diagram, density, positions, goal, threads),
      periodic_(periodic),
      density_value_(density.total(diagram.domain(), threads) / diagram.domain().measure()) {
  periodic_.set_seeds(positions, {});
}

void PeriodicEvaluator::measure(Iterate& at) {
  periodic_.set_weights({at.weights.data(), static_cast<std::size_t>(at.weights.size())});
  const std::vector<PeriodicDiagram::Wall>& walls = periodic_.walls();
  const std::vector<std::uint64_t>& offset = periodic_.wall_offset();
  const Measures& measures = periodic_.measures();
  at.cells.dimension = 2;
  at.cells.mass = measures.mass;
  at.cells.second_moment = measures.second_moment;
  at.cells.centroid = measures.centroid;
  at.cells.status = measures.status;
  at.cells.domain_mass = density_value_ * measures.domain_measure;
  for (double& m : at.cells.mass) m *= density_value_;
  for (double& m : at.cells.second_moment) m *= density_value_;
  std::vector<std::vector<Entry>> rows(size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i] = row_of(std::span(walls).subspan(offset[i], offset[i + 1] - offset[i]));
  make_rows(rows, density_value_, at);
}

}  // namespace powercell
