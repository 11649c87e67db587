// Diagrams on a queue of the caller. Objects of OpenCL come as the integers that pyopencl gives for them
// (`int_ptr`): every loader of OpenCL hands out the same pointers, those of the driver.
#include <mutex>
#include <powercell/opencl.hpp>

#include "python/src/call.hpp"
#include "python/src/options.hpp"

namespace powercell::python {
namespace {

using Pointer = std::uintptr_t;

template <class Handle>
Handle handle_of(Pointer pointer) {
  return reinterpret_cast<Handle>(pointer);
}

/// Calls from several threads wait for each other.
class PyDeviceDiagram {
 public:
  PyDeviceDiagram(const Device& device, const Domain& domain, const nb::dict& options)
      : diagram_(made(device, domain, options_of(options))) {}

  void set_pair_capacity(std::uint32_t pairs) {
    const std::scoped_lock lock(mutex_);
    diagram_.set_pair_capacity(pairs);
  }

  void set_wall_capacity(std::uint32_t walls) {
    const std::scoped_lock lock(mutex_);
    diagram_.set_wall_capacity(walls);
  }

  void set_image_capacity(std::uint32_t images) {
    const std::scoped_lock lock(mutex_);
    diagram_.set_image_capacity(images);
  }

  /// \param results  measures and statuses; offsets, neighbours, walls and shifts of the adjacency; number
  ///   and list of uncertain seeds; the buffers of DeviceCells in their order; offsets, facets and measures
  ///   of boundary walls; 0 for what is not wanted
  /// \param density  the values at vertices; 0: none
  /// \return the event of the last command, which the caller owns
  Pointer enqueue(Pointer positions, Pointer weights, std::uint32_t n, const std::vector<Pointer>& results,
                  Pointer density, const std::vector<Pointer>& events) {
    std::vector<cl_event> wait_list;
    for (const Pointer event : events) wait_list.push_back(handle_of<cl_event>(event));
    return Call(nb::none()).run([&] {
      const std::scoped_lock lock(mutex_);
      cl_event done = nullptr;
      diagram_.set_density(handle_of<cl_mem>(density));
      diagram_.enqueue(handle_of<cl_mem>(positions), handle_of<cl_mem>(weights), n, results_of(results),
                       static_cast<cl_uint>(wait_list.size()), wait_list.data(), &done);
      return reinterpret_cast<Pointer>(done);
    });
  }

  /// \param results, density  as in enqueue()  \return how many cells were computed
  std::uint32_t repair(Pointer positions, Pointer weights, std::uint32_t n,
                       const std::vector<Pointer>& results, Pointer density) {
    return Call(nb::none()).run([&] {
      const std::scoped_lock lock(mutex_);
      diagram_.set_density(handle_of<cl_mem>(density));
      return diagram_.repair(handle_of<cl_mem>(positions), handle_of<cl_mem>(weights), n,
                             results_of(results));
    });
  }

 private:
  static DeviceResults results_of(const std::vector<Pointer>& pointers) {
    const auto memory = [&](std::size_t k) { return handle_of<cl_mem>(pointers.at(k)); };
    return {memory(0),
            memory(1),
            {memory(2), memory(3), memory(4), memory(5)},
            {memory(6), memory(7)},
            {memory(8), memory(9), memory(10), memory(11), memory(12), memory(13), memory(14), memory(15),
             memory(16), memory(17)},
            {memory(18), memory(19), memory(20)}};
  }

  static DeviceDiagram made(const Device& device, const Domain& domain, const Options& options) {
    return Call(nb::none()).run([&] { return DeviceDiagram(device, domain, options); });
  }

  std::mutex mutex_;
  DeviceDiagram diagram_;
};

}  // namespace

void bind_queues(nb::module_& m) {
  m.def("device_from_queue", [](Pointer queue) {
    return Call(nb::none()).run([&] { return device_from_queue(handle_of<cl_command_queue>(queue)); });
  });
  nb::class_<PyDeviceDiagram>(m, "DeviceDiagram")
      .def(nb::init<const Device&, const Domain&, const nb::dict&>())
      .def("set_pair_capacity", &PyDeviceDiagram::set_pair_capacity)
      .def("set_wall_capacity", &PyDeviceDiagram::set_wall_capacity)
      .def("set_image_capacity", &PyDeviceDiagram::set_image_capacity)
      .def("enqueue", &PyDeviceDiagram::enqueue, "positions"_a, "weights"_a, "n"_a, "results"_a, "density"_a,
           "events"_a)
      .def("repair", &PyDeviceDiagram::repair, "positions"_a, "weights"_a, "n"_a, "results"_a, "density"_a);
}

}  // namespace powercell::python
