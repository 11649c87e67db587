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

  /// \param rows  empty, or the offsets, neighbours and walls of the adjacency
  /// \return the event of the last command, which the caller owns
  Pointer enqueue(Pointer positions, Pointer weights, std::uint32_t n, Pointer measures, Pointer status,
                  const std::vector<Pointer>& rows, const std::vector<Pointer>& events) {
    std::vector<cl_event> wait_list;
    for (const Pointer event : events) wait_list.push_back(handle_of<cl_event>(event));
    return Call(nb::none()).run([&] {
      const std::scoped_lock lock(mutex_);
      cl_event done = nullptr;
      const auto wait_count = static_cast<cl_uint>(wait_list.size());
      if (rows.empty())
        diagram_.enqueue(handle_of<cl_mem>(positions), handle_of<cl_mem>(weights), n,
                         handle_of<cl_mem>(measures), handle_of<cl_mem>(status), wait_count, wait_list.data(),
                         &done);
      else
        diagram_.enqueue(
            handle_of<cl_mem>(positions), handle_of<cl_mem>(weights), n, handle_of<cl_mem>(measures),
            handle_of<cl_mem>(status),
            {handle_of<cl_mem>(rows.at(0)), handle_of<cl_mem>(rows.at(1)), handle_of<cl_mem>(rows.at(2))},
            wait_count, wait_list.data(), &done);
      return reinterpret_cast<Pointer>(done);
    });
  }

 private:
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
      .def("enqueue", &PyDeviceDiagram::enqueue, "positions"_a, "weights"_a, "n"_a, "measures"_a, "status"_a,
           "rows"_a, "events"_a);
}

}  // namespace powercell::python
