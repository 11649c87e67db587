#include "lib/c_api/handles.hpp"
#include "lib/c_api/options.hpp"

namespace powercell::c_api {
namespace {

/// The diagram of a handle, before a call that sets what its results depend on: views end here.
Diagram& changing(pc_diagram* handle) {
  Diagram& diagram = diagram_in(handle);
  handle->views = std::make_shared<ResultViews>();
  return diagram;
}

void copy(const Measures& measures, double* mass, double* centroid, double* second_moment, uint8_t* status) {
  copy_out(measures.mass, mass);
  copy_out(measures.centroid, centroid);
  copy_out(measures.second_moment, second_moment);
  copy_out(measures.status, status);
}

}  // namespace

}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

extern "C" {

pc_status pc_diagram_create(const pc_device* device, const pc_domain* domain, const pc_options* options,
                            pc_diagram** diagram) {
  return guarded([&] {
    result_at(diagram);
    hand_over(diagram, Diagram(device_in(device), domain_in(domain), options_of(options)));
  });
}

pc_status pc_prepare(const pc_device* device, const pc_domain* domain, const pc_options* options) {
  return guarded([&] { prepare(device_in(device), domain_in(domain), options_of(options)); });
}

void pc_diagram_destroy(pc_diagram* diagram) {
  if (diagram && diagram->own) delete diagram;
}

pc_status pc_diagram_set_seeds(pc_diagram* diagram, const double* positions, const double* weights,
                               size_t count) {
  return guarded([&] {
    Diagram& target = changing(diagram);
    target.set_seeds(seeds_of(target.domain().dimension(), positions, weights, count));
  });
}

pc_status pc_diagram_set_weights(pc_diagram* diagram, const double* weights, size_t count) {
  return guarded([&] { changing(diagram).set_weights(view(weights, count, "weights")); });
}

pc_status pc_diagram_select(pc_diagram* diagram, const uint32_t* seeds, size_t count) {
  return guarded([&] { changing(diagram).select(view(seeds, count, "seeds")); });
}

pc_status pc_diagram_select_all(pc_diagram* diagram) {
  return guarded([&] { changing(diagram).select_all(); });
}

pc_status pc_diagram_has_selection(const pc_diagram* diagram, int* has_selection) {
  return guarded([&] { result_at(has_selection) = diagram_in(diagram).has_selection(); });
}

pc_status pc_diagram_size(const pc_diagram* diagram, size_t* count) {
  return guarded([&] { result_at(count) = diagram_in(diagram).size(); });
}

pc_status pc_diagram_positions(const pc_diagram* diagram, double* positions) {
  return guarded([&] {
    const Diagram& of = diagram_in(diagram);
    if (of.size() != 0) result_at(positions);
    copy_out(of.positions(), positions);
  });
}

pc_status pc_diagram_precision(const pc_diagram* diagram, pc_precision* precision) {
  return guarded([&] { result_at(precision) = static_cast<pc_precision>(diagram_in(diagram).precision()); });
}

pc_status pc_diagram_neighbors(const pc_diagram* diagram, pc_neighbors* neighbors) {
  return guarded([&] { result_at(neighbors) = static_cast<pc_neighbors>(diagram_in(diagram).neighbors()); });
}

pc_status pc_diagram_domain(const pc_diagram* diagram, pc_domain** domain) {
  return guarded([&] {
    result_at(domain);
    hand_over(domain, diagram_in(diagram).domain());
  });
}

pc_status pc_diagram_device(const pc_diagram* diagram, pc_device** device) {
  return guarded([&] {
    result_at(device);
    hand_over(device, diagram_in(diagram).device());
  });
}

pc_status pc_diagram_compute(pc_diagram* diagram, int adjacency, int cells) {
  return guarded([&] { diagram_in(diagram).compute(adjacency != 0, cells != 0); });
}

pc_status pc_diagram_measures(pc_diagram* diagram, double* mass, double* centroid, double* second_moment,
                              uint8_t* status) {
  return guarded([&] { copy(diagram_in(diagram).measures(), mass, centroid, second_moment, status); });
}

pc_status pc_diagram_adjacency(pc_diagram* diagram, uint64_t* offset, uint32_t* neighbor, double* wall,
                               size_t* count) {
  return guarded([&] {
    checked(count, "count");
    require(neighbor || !wall, "wall needs neighbor: pass both, or NULL for wall");
    const Adjacency& adjacency = diagram_in(diagram).adjacency();
    fit(neighbor, "neighbor", adjacency.neighbor.size(), count);
    copy_out(adjacency.offset, offset);
    copy_out(adjacency.neighbor, neighbor);
    copy_out(adjacency.wall, wall);
  });
}

pc_status pc_diagram_dual(pc_diagram* diagram, int* corners, uint32_t* simplices, size_t* count) {
  return guarded([&] {
    require(count != nullptr && corners != nullptr, "corners and count must not be NULL");
    const Dual& dual = diagram_in(diagram).dual();
    fit(simplices, "simplices", dual.size(), count);
    *corners = dual.corners;
    copy_out(dual.simplices, simplices);
  });
}

pc_status pc_measure(const pc_device* device, const pc_domain* domain, const double* positions,
                     const double* weights, size_t count, const pc_options* options, double* mass,
                     double* centroid, double* second_moment, uint8_t* status) {
  return guarded([&] {
    const Domain& in = domain_in(domain);
    const SeedsView seeds = seeds_of(in.dimension(), positions, weights, count);
    copy(measure(device_in(device), in, seeds, options_of(options)), mass, centroid, second_moment, status);
  });
}

}  // extern "C"
