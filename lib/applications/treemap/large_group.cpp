#include <algorithm>
#include <cmath>
#include <powercell/transport.hpp>
#include <utility>

#include "lib/applications/treemap/relax.hpp"

namespace powercell::treemap_detail {
namespace {

Domain as_domain(const Columns& outline) {
  PolygonPart part;
  for (std::size_t v = 0; v < outline.size(); ++v) part.outer.push_back({outline.x[v], outline.y[v]});
  return Domain::polygon({&part, 1});
}

Columns as_columns(const std::vector<double>& rows) {
  Columns columns;
  columns.resize(rows.size() / 2);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    columns.x[i] = rows[2 * i];
    columns.y[i] = rows[2 * i + 1];
  }
  return columns;
}

std::vector<double> as_rows(const Columns& columns) {
  std::vector<double> rows;
  for (std::size_t i = 0; i < columns.size(); ++i) rows.insert(rows.end(), {columns.x[i], columns.y[i]});
  return rows;
}

TransportOptions make_options(int threads, std::function<bool()> go_on) {
  TransportOptions options;
  options.rescale = true;  // shares sum to 1 up to rounding, as does the area
  options.diagram.threads = threads;
  options.progress = [go_on = std::move(go_on)](const TransportStep&) { return go_on(); };
  return options;
}

/// The solver of relax() for large groups.
struct DeviceSolver {
  const Device& device;
  const Domain& domain;
  std::span<const double> target;
  TransportOptions options;
  TransportSolver transport;
  std::vector<double> positions;
  Columns centroids;
  int& solves;  ///< done so far
  std::uint64_t diagrams = 0, newton_steps = 0;

  void start(const Columns& seeds) {
    positions = as_rows(seeds);
    transport.set_seeds({2, positions, {}});
    transport.set_masses(target);
  }
  bool voronoi() {
    ++diagrams;
    const Measures measures = measure(device, domain, {2, positions, {}}, options.diagram);
    centroids = as_columns(measures.centroid);
    return measures.count(SeedStatus::ok) == centroids.size();
  }
  void move(const Columns& seeds) {
    positions = as_rows(seeds);
    transport.move_seeds(positions);
  }
  bool solve(double tolerance) {
    transport.set_tolerance(tolerance);
    const TransportResult& result = transport.solve();
    diagrams += result.diagrams;
    newton_steps += result.newton_steps();
    ++solves;
    centroids = as_columns(result.centroid);
    return result.converged;
  }
  const Columns& centroid() const { return centroids; }
  /// TransportSolver recovers empty cells, except those thinner than rounding.
  bool has_lost_cells() const {
    return std::ranges::any_of(centroids.x, [](double x) { return std::isnan(x); });
  }
};

}  // namespace

GroupLayout lay_out_large(const Group& group, const GroupSettings& settings, const Device& device,
                          int threads, const std::function<bool(double)>& progress) {
  const Domain domain = as_domain(group.outline);
  int solves = 0;  // at most one for each round, and the last
  const TransportOptions options =
      make_options(threads, [&] { return progress(static_cast<double>(solves) / (settings.rounds + 1)); });
  DeviceSolver solver{device, domain, group.share, options, TransportSolver(device, domain, options),
                      {},     {},     solves};
  GroupLayout layout;
  relax(solver, group, settings, layout);
  layout.diagrams = solver.diagrams;
  layout.newton_steps = solver.newton_steps;
  const JoinedCells cells = join(domain, solver.transport.diagram().cells());
  layout.offset.assign(1, 0);
  for (std::size_t i = 0; i < group.share.size(); ++i) {  // a convex cell has one ring, an empty cell none
    const std::uint64_t ring = cells.face_offset[i];
    if (ring < cells.face_offset[i + 1])
      for (std::uint64_t k = cells.loop_offset[ring]; k < cells.loop_offset[ring + 1]; ++k) {
        const std::uint64_t v = cells.vertex_offset[i] + cells.loop[k];
        layout.vertices.insert(layout.vertices.end(), {cells.vertices[2 * v], cells.vertices[2 * v + 1]});
      }
    layout.offset.push_back(layout.vertices.size() / 2);
  }
  return layout;
}

}  // namespace powercell::treemap_detail
