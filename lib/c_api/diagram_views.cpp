// The results of a diagram in its own memory.
#include "lib/c_api/handles.hpp"
#include "lib/c_api/results.hpp"

namespace powercell::c_api {
namespace {

/// Computes a result, points a struct to it and hands that out.
template <class View, class Owned>
pc_status view_result(pc_diagram* diagram, const Owned& (Diagram::*get)(), View ResultViews::*place,
                      const View** out) {
  return guarded([&] {
    result_at(out);
    View& view = (*checked(diagram, "diagram").views).*place;
    view = view_of((diagram->diagram->*get)());
    *out = &view;
  });
}

}  // namespace

}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

extern "C" {

pc_status pc_diagram_measures_view(pc_diagram* diagram, const pc_measures** measures) {
  return view_result(diagram, &Diagram::measures, &ResultViews::measures, measures);
}

pc_status pc_diagram_adjacency_view(pc_diagram* diagram, const pc_adjacency** adjacency) {
  return view_result(diagram, &Diagram::adjacency, &ResultViews::adjacency, adjacency);
}

pc_status pc_diagram_cells_view(pc_diagram* diagram, const pc_cells** cells) {
  return view_result(diagram, &Diagram::cells, &ResultViews::cells, cells);
}

pc_status pc_diagram_joined_view(pc_diagram* diagram, const pc_joined_cells** joined) {
  return view_result(diagram, &Diagram::joined, &ResultViews::joined, joined);
}

pc_status pc_diagram_boundary_walls_view(pc_diagram* diagram, const pc_boundary_walls** walls) {
  return view_result(diagram, &Diagram::boundary_walls, &ResultViews::boundary_walls, walls);
}

pc_status pc_diagram_dual_view(pc_diagram* diagram, const pc_dual** dual) {
  return view_result(diagram, &Diagram::dual, &ResultViews::dual, dual);
}

pc_status pc_diagram_timings_view(pc_diagram* diagram, const pc_timings** timings) {
  return guarded([&] {
    result_at(timings);
    checked(diagram, "diagram").timings = view_of(diagram->diagram->timings());
    *timings = &diagram->timings;
  });
}

pc_status pc_diagram_hold_results(pc_diagram* diagram, pc_results** results) {
  return guarded([&] {
    result_at(results) = new pc_results{diagram_in(diagram).hold_results(), diagram->views};
  });
}

void pc_results_destroy(pc_results* results) {
  delete results;
}

}  // extern "C"
