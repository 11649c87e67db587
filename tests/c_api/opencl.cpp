// Diagrams from device memory to device memory, from C.
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <powercell_opencl.h>

#include <cmath>

#include "tests/c_api/handles.hpp"

using namespace powercell::c_api_test;

namespace {

using DeviceDiagram = Owned<pc_device_diagram, pc_device_diagram_destroy>;

/// A context and an in-order queue of the first device.
struct Queue {
  cl_context context = nullptr;
  cl_command_queue queue = nullptr;
  Queue() {
    cl_platform_id platform = nullptr;
    cl_device_id device = nullptr;
    REQUIRE(clGetPlatformIDs(1, &platform, nullptr) == CL_SUCCESS);
    REQUIRE(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, nullptr) == CL_SUCCESS);
    context = clCreateContext(nullptr, 1, &device, nullptr, nullptr, nullptr);
    REQUIRE(context);
    queue = clCreateCommandQueue(context, device, 0, nullptr);
    REQUIRE(queue);
  }
  Queue(const Queue&) = delete;
  Queue& operator=(const Queue&) = delete;
  ~Queue() {
    clReleaseCommandQueue(queue);
    clReleaseContext(context);
  }
  cl_mem buffer(std::size_t bytes) const {
    return clCreateBuffer(context, CL_MEM_READ_WRITE, bytes, nullptr, nullptr);
  }
};

}  // namespace

TEST_CASE("a diagram in the caller's queue has the measures of the grid") {
  const Queue own;
  Device device;
  Domain domain;
  DeviceDiagram diagram;
  REQUIRE(pc_device_from_queue(own.queue, &device.handle) == PC_OK);
  REQUIRE(pc_domain_box(low, high, 2, &domain.handle) == PC_OK);
  pc_options options;
  REQUIRE(pc_options_init(&options, sizeof options) == PC_OK);
  options.precision = PC_FLOAT32;
  REQUIRE(pc_device_diagram_create(device.handle, domain.handle, &options, &diagram.handle) == PC_OK);
  pc_precision precision = PC_FLOAT64;
  REQUIRE(pc_device_diagram_precision(diagram.handle, &precision) == PC_OK);
  CHECK(precision == PC_FLOAT32);
  REQUIRE(pc_device_diagram_set_pair_capacity(diagram.handle, 100) == PC_OK);
  Domain same_domain;
  Device same_device;
  REQUIRE(pc_device_diagram_domain(diagram.handle, &same_domain.handle) == PC_OK);
  REQUIRE(pc_device_diagram_device(diagram.handle, &same_device.handle) == PC_OK);
  double measure = 0;
  REQUIRE(pc_domain_measure(same_domain.handle, &measure) == PC_OK);
  CHECK(measure == 2);
  CHECK(std::string(pc_device_name(same_device.handle)) == pc_device_name(device.handle));

  const cl_float positions[10] = {0.5F, 0.25F, 1.5F, 0.25F, 0.5F, 0.75F, 1.5F, 0.75F, NAN, 0};
  const cl_mem seeds = own.buffer(sizeof positions), measures = own.buffer(5 * 4 * sizeof(cl_float)),
               status = own.buffer(5 * sizeof(cl_uint));
  cl_event ready = nullptr, done = nullptr;
  REQUIRE(clEnqueueWriteBuffer(own.queue, seeds, CL_FALSE, 0, sizeof positions, positions, 0, nullptr,
                               &ready) == CL_SUCCESS);
  REQUIRE(pc_device_diagram_enqueue(diagram.handle, seeds, nullptr, 5, measures, status, 1, &ready, &done) ==
          PC_OK);
  cl_float rows[20];
  cl_uint states[5];
  REQUIRE(clEnqueueReadBuffer(own.queue, measures, CL_TRUE, 0, sizeof rows, rows, 1, &done, nullptr) ==
          CL_SUCCESS);
  REQUIRE(clEnqueueReadBuffer(own.queue, status, CL_TRUE, 0, sizeof states, states, 0, nullptr, nullptr) ==
          CL_SUCCESS);
  for (int i = 0; i < 4; ++i) {
    CHECK(states[i] == PC_DEVICE_SEED_OK);
    CHECK(rows[4 * i] == doctest::Approx(0.5).epsilon(1e-4));
    CHECK(rows[4 * i + 1] == doctest::Approx(positions[2 * i]).epsilon(1e-4));
  }
  CHECK(states[4] == PC_DEVICE_SEED_INVALID);

  const cl_mem offset = own.buffer(6 * sizeof(cl_uint)), neighbor = own.buffer(8 * sizeof(cl_uint)),
               wall = own.buffer(8 * sizeof(cl_float));
  const cl_mem count = own.buffer(sizeof(cl_uint)), uncertain = own.buffer(5 * sizeof(cl_uint));
  const pc_device_results results = {measures,           status, {offset, neighbor, wall, nullptr},
                                     {count, uncertain}, {},     {}};
  REQUIRE(pc_device_diagram_set_wall_capacity(diagram.handle, 50) == PC_OK);
  CHECK(pc_device_diagram_set_wall_capacity(diagram.handle, 0x80000001u) == PC_INVALID_ARGUMENT);
  REQUIRE(pc_device_diagram_enqueue_results(diagram.handle, seeds, nullptr, 5, &results, 0, nullptr,
                                            nullptr) == PC_OK);
  uint32_t computed = 0;
  REQUIRE(pc_device_diagram_repair(diagram.handle, seeds, nullptr, 5, &results, &computed) == PC_OK);
  CHECK(computed == 4);  // they meet in a point
  cl_uint listed[4];
  REQUIRE(clEnqueueReadBuffer(own.queue, uncertain, CL_TRUE, 0, sizeof listed, listed, 0, nullptr, nullptr) ==
          CL_SUCCESS);
  for (cl_uint i = 0; i < 4; ++i) CHECK(listed[i] == i);
  cl_uint offsets[6], neighbors[8];
  cl_float lengths[8];
  REQUIRE(clEnqueueReadBuffer(own.queue, offset, CL_TRUE, 0, sizeof offsets, offsets, 0, nullptr, nullptr) ==
          CL_SUCCESS);
  REQUIRE(clEnqueueReadBuffer(own.queue, neighbor, CL_TRUE, 0, sizeof neighbors, neighbors, 0, nullptr,
                              nullptr) == CL_SUCCESS);
  REQUIRE(clEnqueueReadBuffer(own.queue, wall, CL_TRUE, 0, sizeof lengths, lengths, 0, nullptr, nullptr) ==
          CL_SUCCESS);
  const cl_uint expected_offsets[6] = {0, 2, 4, 6, 8, 8}, expected_neighbors[8] = {1, 2, 0, 3, 0, 3, 1, 2};
  const double expected_lengths[8] = {0.5, 1, 0.5, 1, 1, 0.5, 1, 0.5};
  for (int i = 0; i < 6; ++i) CHECK(offsets[i] == expected_offsets[i]);
  for (int k = 0; k < 8; ++k) {
    CHECK(neighbors[k] == expected_neighbors[k]);
    CHECK(lengths[k] == doctest::Approx(expected_lengths[k]).epsilon(1e-4));
  }
  CHECK(pc_device_diagram_enqueue_results(diagram.handle, seeds, nullptr, 5, nullptr, 0, nullptr, nullptr) ==
        PC_INVALID_ARGUMENT);
  CHECK(pc_device_diagram_repair(diagram.handle, seeds, nullptr, 5, nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_device_diagram_repair(nullptr, seeds, nullptr, 5, &results, nullptr) == PC_INVALID_ARGUMENT);
  const pc_device_results no_list = {measures, status, {}, {}, {}, {}};
  CHECK(pc_device_diagram_repair(diagram.handle, seeds, nullptr, 5, &no_list, nullptr) ==
        PC_INVALID_ARGUMENT);
  CHECK(std::string(pc_last_error()).find("no list of uncertain seeds") != std::string::npos);
  for (const cl_mem memory : {offset, neighbor, wall, count, uncertain}) clReleaseMemObject(memory);

  CHECK(pc_device_diagram_enqueue(diagram.handle, seeds, nullptr, 500, measures, status, 0, nullptr,
                                  nullptr) == PC_INVALID_ARGUMENT);  // buffers too small
  CHECK(pc_device_diagram_enqueue(diagram.handle, nullptr, nullptr, 5, measures, status, 0, nullptr,
                                  nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_device_diagram_enqueue(diagram.handle, seeds, nullptr, 5, measures, status, 1, nullptr, nullptr) ==
        PC_INVALID_ARGUMENT);
  clReleaseEvent(ready);
  clReleaseEvent(done);
  for (cl_mem memory : {seeds, measures, status}) clReleaseMemObject(memory);
}

TEST_CASE("the geometry of two cells of a box in device memory") {
  const Queue own;
  Device device;
  Domain domain;
  DeviceDiagram diagram;
  REQUIRE(pc_device_from_queue(own.queue, &device.handle) == PC_OK);
  REQUIRE(pc_domain_box(low, high, 3, &domain.handle) == PC_OK);
  pc_options options;
  REQUIRE(pc_options_init(&options, sizeof options) == PC_OK);
  options.precision = PC_FLOAT32;
  REQUIRE(pc_device_diagram_create(device.handle, domain.handle, &options, &diagram.handle) == PC_OK);
  const cl_float position[6] = {0.5F, 0.5F, 0.5F, 1.5F, 0.5F, 0.5F};
  const cl_mem seeds = own.buffer(sizeof position), measures = own.buffer(2 * 5 * sizeof(cl_float)),
               status = own.buffer(2 * sizeof(cl_uint)), count = own.buffer(sizeof(cl_uint)),
               uncertain = own.buffer(2 * sizeof(cl_uint)), counts = own.buffer(4 * sizeof(cl_ulong)),
               cell_offset = own.buffer(3 * sizeof(cl_ulong)), region = own.buffer(2 * sizeof(cl_uint)),
               vertex_offset = own.buffer(3 * sizeof(cl_ulong)),
               vertices = own.buffer(16 * 3 * sizeof(cl_float)),
               face_offset = own.buffer(3 * sizeof(cl_ulong)), border = own.buffer(12 * 2 * sizeof(cl_uint)),
               loop_offset = own.buffer(13 * sizeof(cl_ulong)), loop = own.buffer(48 * sizeof(cl_uint));
  REQUIRE(clEnqueueWriteBuffer(own.queue, seeds, CL_TRUE, 0, sizeof position, position, 0, nullptr,
                               nullptr) == CL_SUCCESS);
  pc_device_results results = {
      measures,
      status,
      {},
      {count, uncertain},
      {counts, cell_offset, region, vertex_offset, vertices, face_offset, border, nullptr, loop_offset, loop},
      {}};
  REQUIRE(pc_device_diagram_enqueue_results(diagram.handle, seeds, nullptr, 2, &results, 0, nullptr,
                                            nullptr) == PC_OK);
  REQUIRE(pc_device_diagram_repair(diagram.handle, seeds, nullptr, 2, &results, nullptr) == PC_OK);
  const auto read = [&](cl_mem memory, std::size_t bytes, void* to) {
    REQUIRE(clEnqueueReadBuffer(own.queue, memory, CL_TRUE, 0, bytes, to, 0, nullptr, nullptr) == CL_SUCCESS);
  };
  cl_ulong numbers[4], offsets[3];
  cl_float points[48];
  cl_uint borders[24], loops[48];
  read(counts, sizeof numbers, numbers);
  const cl_ulong expected[4] = {2, 16, 12, 48};
  for (int k = 0; k < 4; ++k) REQUIRE(numbers[k] == expected[k]);
  read(cell_offset, sizeof offsets, offsets);
  for (cl_ulong i = 0; i < 3; ++i) CHECK(offsets[i] == i);
  read(vertices, sizeof points, points);
  for (int v = 0; v < 16; ++v) {  // the wall is at x = 1
    CHECK(points[3 * v] >= (v < 8 ? 0.0F : 1.0F));
    CHECK(points[3 * v] <= (v < 8 ? 1.0F : 2.0F));
  }
  read(border, sizeof borders, borders);
  int walls = 0;
  for (cl_uint f = 0; f < 12; ++f)
    if (borders[2 * f] == PC_BORDER_WALL) {
      ++walls;
      CHECK(borders[2 * f + 1] == (f < 6 ? 1u : 0u));
    }
  CHECK(walls == 2);
  read(loop, sizeof loops, loops);
  for (const cl_uint vertex : loops) CHECK(vertex < 8);
  results.cells.loop = nullptr;
  CHECK(pc_device_diagram_enqueue_results(diagram.handle, seeds, nullptr, 2, &results, 0, nullptr, nullptr) ==
        PC_INVALID_ARGUMENT);
  for (const cl_mem memory : {seeds, measures, status, count, uncertain, counts, cell_offset, region,
                              vertex_offset, vertices, face_offset, border, loop_offset, loop})
    clReleaseMemObject(memory);
}

TEST_CASE("the boundary walls of two cells of a rectangle in device memory") {
  const Queue own;
  Device device;
  Domain domain;
  DeviceDiagram diagram;
  REQUIRE(pc_device_from_queue(own.queue, &device.handle) == PC_OK);
  REQUIRE(pc_domain_box(low, high, 2, &domain.handle) == PC_OK);
  pc_options options;
  REQUIRE(pc_options_init(&options, sizeof options) == PC_OK);
  options.precision = PC_FLOAT32;
  REQUIRE(pc_device_diagram_create(device.handle, domain.handle, &options, &diagram.handle) == PC_OK);
  const cl_float position[4] = {0.5F, 0.5F, 1.5F, 0.5F};
  const cl_mem seeds = own.buffer(sizeof position), measures = own.buffer(2 * 4 * sizeof(cl_float)),
               status = own.buffer(2 * sizeof(cl_uint)), count = own.buffer(sizeof(cl_uint)),
               uncertain = own.buffer(2 * sizeof(cl_uint)), offset = own.buffer(3 * sizeof(cl_uint)),
               facet = own.buffer(6 * sizeof(cl_uint)), measure = own.buffer(6 * sizeof(cl_float));
  REQUIRE(clEnqueueWriteBuffer(own.queue, seeds, CL_TRUE, 0, sizeof position, position, 0, nullptr,
                               nullptr) == CL_SUCCESS);
  pc_device_results results = {measures, status, {}, {count, uncertain}, {}, {offset, facet, measure}};
  REQUIRE(pc_device_diagram_enqueue_results(diagram.handle, seeds, nullptr, 2, &results, 0, nullptr,
                                            nullptr) == PC_OK);
  REQUIRE(pc_device_diagram_repair(diagram.handle, seeds, nullptr, 2, &results, nullptr) == PC_OK);
  const auto read = [&](cl_mem memory, std::size_t bytes, void* to) {
    REQUIRE(clEnqueueReadBuffer(own.queue, memory, CL_TRUE, 0, bytes, to, 0, nullptr, nullptr) == CL_SUCCESS);
  };
  cl_uint offsets[3], facets[6];
  cl_float lengths[6];
  read(offset, sizeof offsets, offsets);
  for (cl_uint i = 0; i < 3; ++i) REQUIRE(offsets[i] == 3 * i);
  read(facet, sizeof facets, facets);
  read(measure, sizeof lengths, lengths);
  const cl_uint expected[6] = {0, 2, 3, 0, 1, 2};  // -y +y -x, -y +x +y
  for (int k = 0; k < 6; ++k) {
    CHECK(facets[k] == expected[k]);
    CHECK(lengths[k] == doctest::Approx(1).epsilon(1e-5));
  }
  results.boundary_walls.facet = nullptr;
  CHECK(pc_device_diagram_enqueue_results(diagram.handle, seeds, nullptr, 2, &results, 0, nullptr, nullptr) ==
        PC_INVALID_ARGUMENT);
  CHECK(std::string(pc_last_error()).find("the facets of boundary walls is null") != std::string::npos);
  for (const cl_mem memory : {seeds, measures, status, count, uncertain, offset, facet, measure})
    clReleaseMemObject(memory);
}

TEST_CASE("walls across the borders of a periodic box in device memory") {
  const Queue own;
  Device device;
  Domain periodic;
  DeviceDiagram diagram;
  REQUIRE(pc_device_from_queue(own.queue, &device.handle) == PC_OK);
  REQUIRE(pc_domain_periodic_box(low, high, nullptr, 2, &periodic.handle) == PC_OK);
  pc_options options;
  REQUIRE(pc_options_init(&options, sizeof options) == PC_OK);
  options.precision = PC_FLOAT32;
  REQUIRE(pc_device_diagram_create(device.handle, periodic.handle, &options, &diagram.handle) == PC_OK);
  REQUIRE(pc_device_diagram_set_image_capacity(diagram.handle, 100) == PC_OK);
  const cl_float position[2] = {0.5F, 0.25F};
  const cl_mem seed = own.buffer(sizeof position), measures = own.buffer(4 * sizeof(cl_float)),
               status = own.buffer(sizeof(cl_uint)), offset = own.buffer(2 * sizeof(cl_uint)),
               neighbor = own.buffer(8 * sizeof(cl_uint)), wall = own.buffer(8 * sizeof(cl_float)),
               shift = own.buffer(8 * 3 * sizeof(cl_int)), count = own.buffer(sizeof(cl_uint)),
               uncertain = own.buffer(sizeof(cl_uint));
  REQUIRE(clEnqueueWriteBuffer(own.queue, seed, CL_TRUE, 0, sizeof position, position, 0, nullptr, nullptr) ==
          CL_SUCCESS);
  const pc_device_results results = {measures,           status, {offset, neighbor, wall, shift},
                                     {count, uncertain}, {},     {}};
  REQUIRE(pc_device_diagram_enqueue_results(diagram.handle, seed, nullptr, 1, &results, 0, nullptr,
                                            nullptr) == PC_OK);
  REQUIRE(pc_device_diagram_repair(diagram.handle, seed, nullptr, 1, &results, nullptr) == PC_OK);
  cl_uint offsets[2];
  cl_int shifts[12];
  REQUIRE(clEnqueueReadBuffer(own.queue, offset, CL_TRUE, 0, sizeof offsets, offsets, 0, nullptr, nullptr) ==
          CL_SUCCESS);
  REQUIRE(offsets[1] == 4);  // the cell is the box, and borders itself
  REQUIRE(clEnqueueReadBuffer(own.queue, shift, CL_TRUE, 0, sizeof shifts, shifts, 0, nullptr, nullptr) ==
          CL_SUCCESS);
  const cl_int expected[12] = {-1, 0, 0, 0, -1, 0, 0, 1, 0, 1, 0, 0};
  for (int k = 0; k < 12; ++k) CHECK(shifts[k] == expected[k]);
  const pc_device_results no_shift = {measures,           status, {offset, neighbor, wall, nullptr},
                                      {count, uncertain}, {},     {}};
  CHECK(pc_device_diagram_enqueue_results(diagram.handle, seed, nullptr, 1, &no_shift, 0, nullptr, nullptr) ==
        PC_INVALID_ARGUMENT);
  for (const cl_mem memory : {seed, measures, status, offset, neighbor, wall, shift, count, uncertain})
    clReleaseMemObject(memory);
}

TEST_CASE("queues and diagrams that cannot be used are refused") {
  const Queue own;
  Device device;
  pc_device* no_device = nullptr;
  CHECK(pc_device_from_queue(nullptr, &no_device) == PC_INVALID_ARGUMENT);
  CHECK(pc_device_from_queue(own.queue, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(no_device == nullptr);
  REQUIRE(pc_device_from_queue(own.queue, &device.handle) == PC_OK);
  Domain periodic;
  REQUIRE(pc_domain_periodic_box(low, high, nullptr, 2, &periodic.handle) == PC_OK);
  pc_device_diagram* none = nullptr;
  CHECK(pc_device_diagram_create(nullptr, periodic.handle, nullptr, &none) == PC_INVALID_ARGUMENT);
  CHECK(pc_device_diagram_create(device.handle, nullptr, nullptr, &none) == PC_INVALID_ARGUMENT);
  CHECK(none == nullptr);
  CHECK(pc_device_diagram_set_pair_capacity(nullptr, 1) == PC_INVALID_ARGUMENT);
  CHECK(pc_device_diagram_set_image_capacity(nullptr, 1) == PC_INVALID_ARGUMENT);
  CHECK(pc_device_diagram_precision(nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_device_diagram_domain(nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_device_diagram_device(nullptr, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(pc_device_diagram_enqueue(nullptr, nullptr, nullptr, 0, nullptr, nullptr, 0, nullptr, nullptr) ==
        PC_INVALID_ARGUMENT);
  pc_device_diagram_destroy(nullptr);
}

TEST_CASE("the masses of two cells of a tetrahedron with a density in device memory") {
  const Queue own;
  Device device;
  Domain domain, box;
  DeviceDiagram diagram, in_box;
  REQUIRE(pc_device_from_queue(own.queue, &device.handle) == PC_OK);
  const double corner[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const uint32_t tetrahedron[4] = {0, 1, 2, 3};
  REQUIRE(pc_domain_volume(corner, 4, tetrahedron, 1, &domain.handle) == PC_OK);
  pc_options options;
  REQUIRE(pc_options_init(&options, sizeof options) == PC_OK);
  options.precision = PC_FLOAT32;
  REQUIRE(pc_device_diagram_create(device.handle, domain.handle, &options, &diagram.handle) == PC_OK);
  // The wall is at x = 1/2; density x.
  const cl_float position[6] = {0.25F, 0, 0, 0.75F, 0, 0}, value[4] = {0, 1, 0, 0};
  const cl_mem seeds = own.buffer(sizeof position), density = own.buffer(sizeof value),
               measures = own.buffer(2 * 5 * sizeof(cl_float)), status = own.buffer(2 * sizeof(cl_uint));
  const auto write = [&](cl_mem memory, std::size_t bytes, const void* from) {
    REQUIRE(clEnqueueWriteBuffer(own.queue, memory, CL_TRUE, 0, bytes, from, 0, nullptr, nullptr) ==
            CL_SUCCESS);
  };
  write(seeds, sizeof position, position);
  write(density, sizeof value, value);
  REQUIRE(pc_device_diagram_set_density(diagram.handle, density) == PC_OK);
  REQUIRE(pc_device_diagram_enqueue(diagram.handle, seeds, nullptr, 2, measures, status, 0, nullptr,
                                    nullptr) == PC_OK);
  cl_float rows[10];
  REQUIRE(clEnqueueReadBuffer(own.queue, measures, CL_TRUE, 0, sizeof rows, rows, 0, nullptr, nullptr) ==
          CL_SUCCESS);
  // Of x (1 - x)^2 / 2 and x^2 (1 - x)^2 / 2, the integrals to 1/2 and from there to 1.
  CHECK(rows[0] == doctest::Approx(11.0 / 384).epsilon(1e-4));
  CHECK(rows[5] == doctest::Approx(5.0 / 384).epsilon(1e-4));
  CHECK(rows[1] == doctest::Approx(1.0 / 120 / (11.0 / 384)).epsilon(1e-4));
  CHECK(rows[6] == doctest::Approx(1.0 / 120 / (5.0 / 384)).epsilon(1e-4));
  REQUIRE(pc_device_diagram_set_density(diagram.handle, nullptr) == PC_OK);
  REQUIRE(pc_device_diagram_enqueue(diagram.handle, seeds, nullptr, 2, measures, status, 0, nullptr,
                                    nullptr) == PC_OK);
  REQUIRE(clEnqueueReadBuffer(own.queue, measures, CL_TRUE, 0, sizeof rows, rows, 0, nullptr, nullptr) ==
          CL_SUCCESS);
  CHECK(rows[0] == doctest::Approx(7.0 / 48).epsilon(1e-4));
  const cl_mem small = own.buffer(3 * sizeof(cl_float));
  CHECK(pc_device_diagram_set_density(diagram.handle, small) == PC_INVALID_ARGUMENT);
  CHECK(pc_device_diagram_set_density(nullptr, density) == PC_INVALID_ARGUMENT);
  REQUIRE(pc_domain_box(low, high, 3, &box.handle) == PC_OK);
  REQUIRE(pc_device_diagram_create(device.handle, box.handle, &options, &in_box.handle) == PC_OK);
  CHECK(pc_device_diagram_set_density(in_box.handle, density) == PC_UNSUPPORTED);
  for (const cl_mem memory : {seeds, density, measures, status, small}) clReleaseMemObject(memory);
}
