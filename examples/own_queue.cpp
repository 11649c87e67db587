// A diagram on the caller's own OpenCL context and command queue, beside kernels of the caller.
#include <cstdio>
#include <powercell/opencl.hpp>
#include <powercell/powercell.hpp>
#include <random>
#include <vector>

int main() try {
  cl_platform_id platform = nullptr;
  cl_device_id device_id = nullptr;
  if (clGetPlatformIDs(1, &platform, nullptr) != CL_SUCCESS ||
      clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device_id, nullptr) != CL_SUCCESS) {
    std::fprintf(stderr, "no OpenCL device: on Debian, apt-get install pocl-opencl-icd runs on the CPU\n");
    return 1;
  }
  cl_int status = CL_SUCCESS;
  cl_context context = clCreateContext(nullptr, 1, &device_id, nullptr, nullptr, &status);
  cl_command_queue queue = context ? clCreateCommandQueue(context, device_id, 0, &status) : nullptr;
  if (!queue) {
    std::fprintf(stderr, "no context or queue: OpenCL error %d\n", status);
    return 1;
  }

  double error = 1;
  {
    const powercell::Device device = powercell::device_from_queue(queue);  // retains queue and context
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<double> positions(3 * 1000);
    for (double& x : positions) x = unit(random);
    const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
    const powercell::Measures measures =
        powercell::measure(device, powercell::Domain::box(low, high), {3, positions, {}});
    error = measures.relative_error();
    std::printf("%zu cells on %s in the caller's queue, relative error of the volume %.1e\n",
                measures.count(powercell::SeedStatus::ok), device.info().name.c_str(), error);
  }  // the device lets go of the queue here
  clReleaseCommandQueue(queue);
  clReleaseContext(context);
  return error < 1e-5 ? 0 : 1;
} catch (const powercell::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
