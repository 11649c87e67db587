// A diagram between kernels of the caller: seeds and measures are buffers in the caller's OpenCL context, all
// commands go to the caller's queue, and nothing is copied to the host in between.
#define CL_TARGET_OPENCL_VERSION 120  // or what you work with: powercell leaves it to you
#include <CL/cl.h>

#include <cmath>
#include <cstdio>
#include <powercell/opencl.hpp>
#include <powercell/powercell.hpp>
#include <random>
#include <vector>

namespace {

// Computes the measures of the cells of n seeds in the unit cube, all in device memory; returns the sum of
// the volumes.
double volume_of_cells(cl_context context, cl_command_queue queue, cl_uint n) {
  const powercell::Device device = powercell::device_from_queue(queue);  // retains queue and context
  const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
  powercell::Options options;
  options.precision = powercell::Precision::float32;  // so the buffers hold cl_float
  powercell::DeviceDiagram diagram(device, powercell::Domain::box(low, high), options);

  std::mt19937_64 random(1);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<cl_float> numbers(3 * n);
  for (cl_float& x : numbers) x = unit(random);
  cl_mem positions = clCreateBuffer(context, CL_MEM_READ_ONLY, 3 * n * sizeof(cl_float), nullptr, nullptr);
  cl_mem measures = clCreateBuffer(context, CL_MEM_READ_WRITE, 5 * n * sizeof(cl_float), nullptr, nullptr);
  cl_mem status = clCreateBuffer(context, CL_MEM_READ_WRITE, n * sizeof(cl_uint), nullptr, nullptr);

  // Here a kernel of the caller would write the seeds; a non-blocking copy stands in for it.
  cl_event seeds_ready = nullptr, diagram_done = nullptr;
  clEnqueueWriteBuffer(queue, positions, CL_FALSE, 0, numbers.size() * sizeof(cl_float), numbers.data(), 0,
                       nullptr, &seeds_ready);
  diagram.enqueue(positions, nullptr, n, measures, status, 1, &seeds_ready, &diagram_done);

  // Here a kernel of the caller would use the measures; a blocking read stands in for it.
  std::vector<cl_float> rows(5 * n);  // volume, centroid x y z, second moment
  clEnqueueReadBuffer(queue, measures, CL_TRUE, 0, rows.size() * sizeof(cl_float), rows.data(), 1,
                      &diagram_done, nullptr);
  double volume = 0;
  for (cl_uint i = 0; i < n; ++i) volume += rows[5 * i];
  std::printf("%u cells on %s in the caller's queue and buffers, volume %.6f\n", n,
              device.info().name.c_str(), volume);

  clReleaseEvent(seeds_ready);
  clReleaseEvent(diagram_done);
  for (cl_mem memory : {positions, measures, status}) clReleaseMemObject(memory);
  return volume;
}

}  // namespace

int main() try {
  cl_platform_id platform = nullptr;
  cl_device_id device_id = nullptr;
  if (clGetPlatformIDs(1, &platform, nullptr) != CL_SUCCESS ||
      clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device_id, nullptr) != CL_SUCCESS) {
    std::fprintf(stderr,
                 "no OpenCL device found; on Debian, 'apt-get install pocl-opencl-icd' provides the CPU\n");
    return 1;
  }
  cl_int status = CL_SUCCESS;
  cl_context context = clCreateContext(nullptr, 1, &device_id, nullptr, nullptr, &status);
  cl_command_queue queue = context ? clCreateCommandQueue(context, device_id, 0, &status) : nullptr;
  if (!queue) {
    std::fprintf(stderr, "cannot create a context and queue: OpenCL error %d\n", status);
    return 1;
  }
  const double volume = volume_of_cells(context, queue, 1000);
  clReleaseCommandQueue(queue);
  clReleaseContext(context);
  return std::abs(volume - 1) < 1e-4 ? 0 : 1;
} catch (const powercell::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
