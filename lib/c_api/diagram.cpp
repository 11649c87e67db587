#include "lib/c_api/handles.hpp"
#include "lib/c_api/options.hpp"

namespace powercell::c_api {
namespace {

static_assert(static_cast<int>(SeedStatus::duplicate) == PC_SEED_DUPLICATE);

}  // namespace

extern "C" {

pc_status pc_diagram_create(const pc_device* device, const pc_domain* domain, const pc_options* options,
                            pc_diagram** diagram) {
  return guarded([&] {
    result_at(diagram);
    hand_over(diagram, Diagram(device_in(device), domain_in(domain), options_of(options)));
  });
}

void pc_diagram_destroy(pc_diagram* diagram) {
  delete diagram;
}

pc_status pc_diagram_set_seeds(pc_diagram* diagram, const double* positions, const double* weights,
                               size_t count) {
  return guarded([&] {
    Diagram& target = diagram_in(diagram);
    target.set_seeds(seeds_of(target.domain().dimension(), positions, weights, count));
  });
}

pc_status pc_diagram_set_weights(pc_diagram* diagram, const double* weights, size_t count) {
  return guarded([&] { diagram_in(diagram).set_weights(view(weights, count, "weights")); });
}

pc_status pc_diagram_size(const pc_diagram* diagram, size_t* count) {
  return guarded([&] { result_at(count) = diagram_in(diagram).size(); });
}

pc_status pc_diagram_measures(pc_diagram* diagram, double* mass, double* centroid, double* second_moment,
                              uint8_t* status) {
  return guarded([&] {
    const Measures& measures = diagram_in(diagram).measures();
    copy_out(measures.mass, mass);
    copy_out(measures.centroid, centroid);
    copy_out(measures.second_moment, second_moment);
    copy_out(measures.status, status);
  });
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
    *corners = dual.corners;
    fit(simplices, "simplices", dual.size(), count);
    copy_out(dual.simplices, simplices);
  });
}

}  // extern "C"
}  // namespace powercell::c_api
