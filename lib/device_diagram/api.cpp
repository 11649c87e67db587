#include <algorithm>
#include <powercell/opencl.hpp>
#include <powercell/seeds.hpp>

#include "lib/base/float_environment.hpp"
#include "lib/base/nodal_values.hpp"
#include "lib/device_diagram/device_diagram.hpp"
#include "lib/device_diagram/separate_buffers.hpp"

namespace powercell {
namespace {

constexpr std::size_t shift_bytes = 3 * sizeof(cl_int);

template <class T>
T memory_value(cl_mem memory, cl_mem_info which, const char* name) {
  T value{};
  cl::check(cl::clGetMemObjectInfo(memory, which, sizeof value, &value, nullptr),
            std::string("asking the caller's buffer of ") + name + " for a property");
  return value;
}

/// \throw Error invalid_argument unless the caller's buffer exists, belongs to the device's context and has
///        at least `bytes` bytes
void require_buffer(const cl::Context& context, cl_mem memory, std::size_t bytes, const char* name) {
  if (!memory) throw Error(ErrorCode::invalid_argument, std::string("the buffer of ") + name + " is null");
  if (memory_value<cl_context>(memory, CL_MEM_CONTEXT, name) != context.context())
    throw Error(ErrorCode::invalid_argument,
                std::string("the buffer of ") + name +
                    " belongs to another context than the device's queue; make the device "
                    "with device_from_queue on a queue of the buffer's context");
  const auto size = memory_value<std::size_t>(memory, CL_MEM_SIZE, name);
  if (size < bytes)
    throw Error(ErrorCode::invalid_argument, std::string("the buffer of ") + name + " has " +
                                                 std::to_string(size) + " bytes; it needs " +
                                                 std::to_string(bytes));
}

/// How many values fit a buffer of the caller.
std::size_t values_in(cl_mem memory, std::size_t bytes_each, const char* name) {
  return memory_value<std::size_t>(memory, CL_MEM_SIZE, name) / bytes_each;
}

std::uint32_t in_32_bits(std::size_t count) {
  return static_cast<std::uint32_t>(std::min<std::size_t>(count, 0xffffffffu));
}

/// The arguments of a call.
struct Job {
  cl_mem positions, weights;
  std::uint32_t n;
  DeviceResults results;
};

/// The entries that the caller's rows have room for.
/// \throw Error invalid_argument
std::uint32_t room_for_rows(const DeviceDiagram::State& s, std::uint32_t n, const DeviceAdjacency& rows) {
  const cl::Context& context = *s.device.context();
  const std::size_t real = s.real_bytes();
  if (rows.shift && !s.domain.is_periodic())
    throw Error(ErrorCode::invalid_argument,
                "walls have shifts in periodic domains only; pass no buffer of shifts for this one");
  require_buffer(context, rows.offset, (std::size_t{n} + 1) * sizeof(cl_uint), "offsets");
  if (n == 0) return 0;
  require_buffer(context, rows.neighbor, sizeof(cl_uint), "neighbors");
  require_buffer(context, rows.wall, real, "walls");
  const std::size_t room =
      std::min(values_in(rows.neighbor, sizeof(cl_uint), "neighbors"), values_in(rows.wall, real, "walls"));
  if (!s.domain.is_periodic()) return in_32_bits(room);
  require_buffer(context, rows.shift, shift_bytes, "shifts");
  return in_32_bits(std::min(room, values_in(rows.shift, shift_bytes, "shifts")));
}

/// The seeds that the caller's list has room for.
/// \throw Error invalid_argument
std::uint32_t room_for_list(const DeviceDiagram::State& s, std::uint32_t n, const DeviceUncertain& list) {
  const cl::Context& context = *s.device.context();
  require_buffer(context, list.count, sizeof(cl_uint), "the number of uncertain seeds");
  if (n == 0) return 0;
  require_buffer(context, list.seeds, sizeof(cl_uint), "uncertain seeds");
  return in_32_bits(values_in(list.seeds, sizeof(cl_uint), "uncertain seeds"));
}

/// The entries that the caller's boundary walls have room for.
/// \throw Error invalid_argument
std::uint32_t room_for_boundary(const DeviceDiagram::State& s, std::uint32_t n,
                                const DeviceBoundaryWalls& rows) {
  const cl::Context& context = *s.device.context();
  const std::size_t real = s.real_bytes();
  require_buffer(context, rows.offset, (std::size_t{n} + 1) * sizeof(cl_uint),
                 "the offsets of boundary walls");
  if (n == 0) return 0;
  require_buffer(context, rows.facet, sizeof(cl_uint), "the facets of boundary walls");
  require_buffer(context, rows.measure, real, "the measures of boundary walls");
  return in_32_bits(std::min(values_in(rows.facet, sizeof(cl_uint), "the facets of boundary walls"),
                             values_in(rows.measure, real, "the measures of boundary walls")));
}

/// How many values fit a buffer of the caller, which there is.
/// \throw Error invalid_argument
std::size_t room_in(const cl::Context& context, cl_mem memory, std::size_t bytes_each, const char* name) {
  require_buffer(context, memory, bytes_each, name);
  return values_in(memory, bytes_each, name);
}

/// What the caller's cells have room for.
/// \throw Error invalid_argument
CellRooms room_for_cells(const DeviceDiagram::State& s, std::uint32_t n, const DeviceCells& cells) {
  const cl::Context& context = *s.device.context();
  const bool volume = s.domain.cell_dimension() == 3, periodic = s.domain.is_periodic();
  if (cells.shift && !periodic)
    throw Error(ErrorCode::invalid_argument,
                "faces have shifts in periodic domains only; pass no buffer of shifts for this one");
  if ((cells.loop_offset || cells.loop) && !volume)
    throw Error(ErrorCode::invalid_argument,
                "faces have loops in cells of dimension 3 only; pass no buffers of loops for this domain");
  require_buffer(context, cells.counts, 4 * sizeof(cl_ulong), "the counts of cells");
  require_buffer(context, cells.cell_offset, (std::size_t{n} + 1) * sizeof(cl_ulong), "the offsets of cells");
  if (n == 0) return {};
  const auto room = [&](cl_mem memory, std::size_t bytes_each, const char* name) {
    return room_in(context, memory, bytes_each, name);
  };
  const auto offsets = [&](cl_mem memory, const char* name) {
    return room_in(context, memory, sizeof(cl_ulong), name) - 1;
  };
  const std::size_t vertex = static_cast<std::size_t>(s.domain.dimension()) * s.real_bytes();
  CellRooms rooms{std::min({room(cells.region, sizeof(cl_uint), "the regions of pieces"),
                            offsets(cells.vertex_offset, "the offsets of vertices"),
                            offsets(cells.face_offset, "the offsets of faces")}),
                  room(cells.vertices, vertex, "vertices"),
                  room(cells.border, 2 * sizeof(cl_uint), "the borders of faces"), 0};
  if (periodic) rooms.faces = std::min(rooms.faces, room(cells.shift, shift_bytes, "the shifts of faces"));
  if (!volume) return rooms;
  rooms.faces = std::min(rooms.faces, offsets(cells.loop_offset, "the offsets of loops"));
  rooms.loop = room(cells.loop, sizeof(cl_uint), "loops");
  return rooms;
}

void require_separate(const Job& job, cl_mem density) {
  const DeviceResults& to = job.results;
  const CallersBuffer buffers[] = {
      {job.positions, "positions", false},
      {job.weights, "weights", false},
      {density, "the values of the density", false},
      {to.measures, "measures", true},
      {to.status, "status", true},
      {to.adjacency.offset, "offsets", true},
      {to.adjacency.neighbor, "neighbors", true},
      {to.adjacency.wall, "walls", true},
      {to.adjacency.shift, "shifts", true},
      {to.uncertain.count, "the number of uncertain seeds", true},
      {to.uncertain.seeds, "uncertain seeds", true},
      {to.cells.counts, "the counts of cells", true},
      {to.cells.cell_offset, "the offsets of cells", true},
      {to.cells.region, "the regions of pieces", true},
      {to.cells.vertex_offset, "the offsets of vertices", true},
      {to.cells.vertices, "vertices", true},
      {to.cells.face_offset, "the offsets of faces", true},
      {to.cells.border, "the borders of faces", true},
      {to.cells.shift, "the shifts of faces", true},
      {to.cells.loop_offset, "the offsets of loops", true},
      {to.cells.loop, "loops", true},
      {to.boundary_walls.offset, "the offsets of boundary walls", true},
      {to.boundary_walls.facet, "the facets of boundary walls", true},
      {to.boundary_walls.measure, "the measures of boundary walls", true},
  };
  powercell::require_separate(buffers);
}

/// \throw Error invalid_argument
Rooms checked(const DeviceDiagram::State& s, const Job& job) {
  if (job.n > most_seeds_of_diagram)
    throw Error(ErrorCode::invalid_argument, std::to_string(job.n) + " seeds are more than the " +
                                                 std::to_string(most_seeds_of_diagram) +
                                                 " that one diagram can have");
  const DeviceResults& results = job.results;
  if (job.n > 0) {
    const cl::Context& context = *s.device.context();
    const std::size_t real = s.real_bytes();
    const auto d = static_cast<std::size_t>(s.domain.dimension());
    require_buffer(context, job.positions, job.n * d * real, "positions");
    if (job.weights) require_buffer(context, job.weights, job.n * real, "weights");
    require_buffer(context, results.measures, job.n * (2 + d) * real, "measures");
    require_buffer(context, results.status, job.n * sizeof(cl_uint), "status");
  }
  const Rooms rooms{wants_rows(results) ? room_for_rows(s, job.n, results.adjacency) : 0,
                    wants_list(results) ? room_for_list(s, job.n, results.uncertain) : 0,
                    wants_cells(results) ? room_for_cells(s, job.n, results.cells) : CellRooms{},
                    wants_boundary(results) ? room_for_boundary(s, job.n, results.boundary_walls) : 0};
  require_separate(job, s.density());
  return rooms;
}

/// The diagram of no seeds.
void enqueue_nothing(const cl::Context& context, const DeviceResults& results, cl_event* done) {
  const auto write_zeros = [&](cl_mem memory, std::size_t bytes) {
    const cl_uint zero = 0;
    if (memory)
      cl::check(
          cl::clEnqueueFillBuffer(context.queue(), memory, &zero, sizeof zero, 0, bytes, 0, nullptr, nullptr),
          "writing the results of no seeds");
  };
  write_zeros(results.adjacency.offset, sizeof(cl_uint));
  write_zeros(results.uncertain.count, sizeof(cl_uint));
  write_zeros(results.cells.counts, 4 * sizeof(cl_ulong));
  write_zeros(results.cells.cell_offset, sizeof(cl_ulong));
  write_zeros(results.boundary_walls.offset, sizeof(cl_uint));
  if (done)
    cl::check(cl::clEnqueueMarkerWithWaitList(context.queue(), 0, nullptr, done), "enqueueing a marker");
}

void run(DeviceDiagram::State& s, const Job& job, cl_uint wait_count, const cl_event* wait_list,
         cl_event* done) {
  const cl::Context& context = *s.device.context();
  const Rooms rooms = checked(s, job);
  // The queue is in order, so all later commands wait for the caller's events too.
  if (wait_count > 0)
    cl::check(cl::clEnqueueBarrierWithWaitList(context.queue(), wait_count, wait_list, nullptr),
              "enqueueing a barrier for the caller's events");
  if (job.n > 0)
    s.enqueue(job.positions, job.weights, job.n, job.results, rooms, done);
  else
    enqueue_nothing(context, job.results, done);
  const cl_int flushed = cl::clFlush(context.queue());
  if (flushed != CL_SUCCESS && done) {  // callers get no event with an exception
    cl::clReleaseEvent(*done);
    *done = nullptr;
  }
  cl::check(flushed, "flushing the caller's queue");
}

}  // namespace

DeviceDiagram::DeviceDiagram(Device device, Domain domain, Options options) {
  const FloatEnvironment environment;
  if (options.neighbors == Neighbors::flann)
    throw Error(ErrorCode::unsupported,
                "FLANN makes neighbour lists on the host, so a diagram in device memory cannot use them; use "
                "Neighbors::tree, or Diagram");
  state_ = std::make_unique<State>(std::move(device), std::move(domain), std::move(options));
}
DeviceDiagram::DeviceDiagram(DeviceDiagram&&) noexcept = default;
DeviceDiagram& DeviceDiagram::operator=(DeviceDiagram&&) noexcept = default;
DeviceDiagram::~DeviceDiagram() = default;

const Device& DeviceDiagram::device() const {
  return state_->device;
}
const Domain& DeviceDiagram::domain() const {
  return state_->domain;
}
Precision DeviceDiagram::precision() const {
  return state_->precision;
}

void DeviceDiagram::set_pair_capacity(std::uint32_t pairs) {
  state_->pair_capacity = pairs;
}

void DeviceDiagram::set_image_capacity(std::uint32_t images) {
  state_->image_capacity = images;
}

void DeviceDiagram::set_wall_capacity(std::uint32_t walls) {
  if (walls > DeviceWalls::most_entries)
    throw Error(ErrorCode::invalid_argument,
                std::to_string(walls) + " walls are more than the 2^31 that the store can have");
  state_->wall_capacity = walls;
}

void DeviceDiagram::set_density(cl_mem values) {
  const FloatEnvironment environment;
  if (values) {
    require_simplices(state_->domain);
    const std::size_t vertices = state_->domain.regions().vertices.size() / 3;
    require_buffer(*state_->device.context(), values, vertices * state_->real_bytes(),
                   "the values of the density");
  }
  state_->set_density(values);
}

void DeviceDiagram::enqueue(cl_mem positions, cl_mem weights, std::uint32_t n, cl_mem measures, cl_mem status,
                            cl_uint wait_count, const cl_event* wait_list, cl_event* done) {
  const FloatEnvironment environment;
  run(*state_, {positions, weights, n, {measures, status}}, wait_count, wait_list, done);
}

void DeviceDiagram::enqueue(cl_mem positions, cl_mem weights, std::uint32_t n, const DeviceResults& results,
                            cl_uint wait_count, const cl_event* wait_list, cl_event* done) {
  const FloatEnvironment environment;
  run(*state_, {positions, weights, n, results}, wait_count, wait_list, done);
}

std::uint32_t DeviceDiagram::repair(cl_mem positions, cl_mem weights, std::uint32_t n,
                                    const DeviceResults& results) {
  const FloatEnvironment environment;
  if (!wants_list(results))
    throw Error(ErrorCode::invalid_argument,
                "the results have no list of uncertain seeds; enqueue the diagram with one");
  const Rooms rooms = checked(*state_, {positions, weights, n, results});
  if (n == 0) return 0;
  if (!state_->repair) {
    Options options = state_->options;
    options.precision = state_->precision;
    state_->repair.emplace(state_->device, state_->domain, std::move(options));
  }
  return state_->repair->run(positions, weights, n, results, rooms, state_->density());
}

}  // namespace powercell
