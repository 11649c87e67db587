#include <powercell_opencl.h>

#include <powercell/opencl.hpp>

#include "lib/c_api/handles.hpp"
#include "lib/c_api/options.hpp"

struct pc_device_diagram {
  explicit pc_device_diagram(powercell::DeviceDiagram made) : diagram(std::move(made)) {}
  powercell::DeviceDiagram diagram;
};

namespace powercell::c_api {
namespace {

static_assert(static_cast<int>(DeviceSeedStatus::unfinished) == PC_DEVICE_SEED_UNFINISHED);

DeviceDiagram& diagram_in(pc_device_diagram* handle) {
  return checked(handle, "diagram").diagram;
}
const DeviceDiagram& diagram_in(const pc_device_diagram* handle) {
  return checked(handle, "diagram").diagram;
}

DeviceResults results_of(const pc_device_results* results) {
  const auto& [measures, status, adjacency, uncertain, cells, boundary] = checked(results, "results");
  return {measures,
          status,
          {adjacency.offset, adjacency.neighbor, adjacency.wall, adjacency.shift},
          {uncertain.count, uncertain.seeds},
          {cells.counts, cells.cell_offset, cells.region, cells.vertex_offset, cells.vertices,
           cells.face_offset, cells.border, cells.shift, cells.loop_offset, cells.loop},
          {boundary.offset, boundary.facet, boundary.measure}};
}

}  // namespace
}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

extern "C" {

pc_status pc_device_from_queue(cl_command_queue queue, pc_device** device) {
  return guarded([&] {
    result_at(device);
    hand_over(device, device_from_queue(queue));
  });
}

void* pc_opencl_function(const char* name) {
  return name ? opencl_function(name) : nullptr;
}

pc_status pc_device_diagram_create(const pc_device* device, const pc_domain* domain,
                                   const pc_options* options, pc_device_diagram** diagram) {
  return guarded([&] {
    result_at(diagram);
    hand_over(diagram, DeviceDiagram(device_in(device), domain_in(domain), options_of(options)));
  });
}

void pc_device_diagram_destroy(pc_device_diagram* diagram) {
  delete diagram;
}

pc_status pc_device_diagram_precision(const pc_device_diagram* diagram, pc_precision* precision) {
  return guarded([&] { result_at(precision) = static_cast<pc_precision>(diagram_in(diagram).precision()); });
}

pc_status pc_device_diagram_domain(const pc_device_diagram* diagram, pc_domain** domain) {
  return guarded([&] {
    result_at(domain);
    hand_over(domain, diagram_in(diagram).domain());
  });
}

pc_status pc_device_diagram_device(const pc_device_diagram* diagram, pc_device** device) {
  return guarded([&] {
    result_at(device);
    hand_over(device, diagram_in(diagram).device());
  });
}

pc_status pc_device_diagram_set_pair_capacity(pc_device_diagram* diagram, uint32_t pairs) {
  return guarded([&] { diagram_in(diagram).set_pair_capacity(pairs); });
}

pc_status pc_device_diagram_set_wall_capacity(pc_device_diagram* diagram, uint32_t walls) {
  return guarded([&] { diagram_in(diagram).set_wall_capacity(walls); });
}

pc_status pc_device_diagram_set_image_capacity(pc_device_diagram* diagram, uint32_t images) {
  return guarded([&] { diagram_in(diagram).set_image_capacity(images); });
}

pc_status pc_device_diagram_set_density(pc_device_diagram* diagram, cl_mem values) {
  return guarded([&] { diagram_in(diagram).set_density(values); });
}

pc_status pc_device_diagram_enqueue_results(pc_device_diagram* diagram, cl_mem positions, cl_mem weights,
                                            uint32_t n, const pc_device_results* results, cl_uint wait_count,
                                            const cl_event* wait_list, cl_event* done) {
  return guarded([&] {
    DeviceDiagram& target = diagram_in(diagram);
    const DeviceResults wanted = results_of(results);
    require(wait_count == 0 || wait_list != nullptr, "wait_list is NULL");
    target.enqueue(positions, weights, n, wanted, wait_count, wait_list, done);
  });
}

pc_status pc_device_diagram_repair(pc_device_diagram* diagram, cl_mem positions, cl_mem weights, uint32_t n,
                                   const pc_device_results* results, uint32_t* computed) {
  return guarded([&] {
    const uint32_t count = diagram_in(diagram).repair(positions, weights, n, results_of(results));
    if (computed) *computed = count;
  });
}

pc_status pc_device_diagram_enqueue(pc_device_diagram* diagram, cl_mem positions, cl_mem weights, uint32_t n,
                                    cl_mem measures, cl_mem status, cl_uint wait_count,
                                    const cl_event* wait_list, cl_event* done) {
  return guarded([&] {
    DeviceDiagram& target = diagram_in(diagram);
    require(wait_count == 0 || wait_list != nullptr, "wait_list is NULL");
    target.enqueue(positions, weights, n, measures, status, wait_count, wait_list, done);
  });
}

}  // extern "C"
