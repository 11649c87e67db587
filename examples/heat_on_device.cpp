// A simulation that stays on the device: heat flows through the walls of cells that a vortex carries along, a
// thousand steps long. Each step is a diagram with its adjacency and two kernels; the host only enqueues them
// and reads the result at the end.
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <cmath>
#include <cstdio>
#include <powercell/opencl.hpp>
#include <powercell/powercell.hpp>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

constexpr const char* kernels = R"(
// Heat flows from cell to cell: conductivity x length of the wall / distance of the seeds x difference of the
// temperatures, heat / area. Both sides of a wall are the same number, so heat is neither made nor lost.
__kernel void conduct(const uint n, const uint room, const float step, __global const float2* position,
                      __global const float4* measures, __global const uint* status, __global const uint* offset,
                      __global const uint* neighbor, __global const float* wall, __global const float* heat,
                      __global float* next, __global uint* trouble) {
  const uint i = get_global_id(0);
  if (i >= n) return;
  if (status[i] != 0 || offset[n] > room) {  // no cell, or no room for the walls
    trouble[0] = 1;
    return;
  }
  const float here = heat[i] / measures[i].x;
  float change = 0;
  for (uint k = offset[i]; k < offset[i + 1]; ++k) {
    const uint j = neighbor[k];
    change += wall[k] / distance(position[i], position[j]) * (heat[j] / measures[j].x - here);
  }
  next[i] = heat[i] + step * change;
}

// A vortex that does not cross the border, and a part of the way to the centroid, which keeps cells round.
__kernel void move(const uint n, const float step, __global float2* position, __global const float4* measures) {
  const uint i = get_global_id(0);
  if (i >= n) return;
  const float2 x = position[i], centroid = measures[i].yz;
  const float2 velocity = (float2)(sinpi(x.x) * cospi(x.y), -cospi(x.x) * sinpi(x.y));
  position[i] = x + step * velocity + 0.2f * (centroid - x);
}
)";

void require(cl_int status, const char* what) {
  if (status != CL_SUCCESS)
    throw std::runtime_error(std::string(what) + " failed: OpenCL error " + std::to_string(status));
}

/// Numbers in device memory.
template <class T>
class Numbers {
 public:
  Numbers(cl_context context, std::size_t count, const std::vector<T>& values = {}) : count_(count) {
    std::vector<T> all(values);
    all.resize(count);
    cl_int status = CL_SUCCESS;
    memory_ = clCreateBuffer(context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, count * sizeof(T), all.data(),
                             &status);
    require(status, "creating a buffer");
  }
  Numbers(const Numbers&) = delete;
  Numbers& operator=(const Numbers&) = delete;
  ~Numbers() { clReleaseMemObject(memory_); }
  cl_mem memory() const { return memory_; }
  std::vector<T> read(cl_command_queue queue) const {
    std::vector<T> values(count_);
    require(clEnqueueReadBuffer(queue, memory_, CL_TRUE, 0, count_ * sizeof(T), values.data(), 0, nullptr,
                                nullptr),
            "reading a buffer");
    return values;
  }

 private:
  std::size_t count_;
  cl_mem memory_ = nullptr;
};

template <class... Arguments>
void enqueue(cl_command_queue queue, cl_kernel kernel, std::size_t n, const Arguments&... arguments) {
  cl_uint index = 0;
  (require(clSetKernelArg(kernel, index++, sizeof arguments, &arguments), "setting an argument"), ...);
  require(clEnqueueNDRangeKernel(queue, kernel, 1, nullptr, &n, nullptr, 0, nullptr, nullptr),
          "enqueueing a kernel");
}

/// The heat, and how much temperatures differ: the root of their mean square about the mean.
struct Summary {
  double heat = 0, spread = 0;
  /// \param measures  rows of area, centroid and second moment
  Summary(const std::vector<float>& heats, const std::vector<float>& measures) {
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < heats.size(); ++i) {
      const double temperature = heats[i] / measures[4 * i];
      heat += heats[i];
      sum += temperature;
      squares += temperature * temperature;
    }
    const auto n = static_cast<double>(heats.size());
    spread = std::sqrt(squares / n - sum / n * sum / n);
  }
};

std::vector<float> random_positions(cl_uint n) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<float> positions(2 * n);
  for (float& x : positions) x = unit(random);
  return positions;
}

/// Simulates n cells; returns whether heat was kept and spread.
bool simulate(cl_context context, cl_command_queue queue, cl_program program, cl_uint n, int steps) {
  const powercell::Device device = powercell::device_from_queue(queue);
  const double low[] = {0, 0}, high[] = {1, 1};
  powercell::Options options;
  options.precision = powercell::Precision::float32;  // so the buffers hold cl_float
  powercell::DeviceDiagram diagram(device, powercell::Domain::box(low, high), options);

  const cl_uint room = 8 * n;  // two entries for each wall, and fewer than three walls a seed
  const std::vector<float> start = random_positions(n);
  const Numbers<float> positions(context, 2 * n, start), measures(context, 4 * n), wall(context, room);
  const Numbers<cl_uint> status(context, n), offset(context, n + 1), neighbor(context, room),
      trouble(context, 1);
  const powercell::DeviceAdjacency rows{offset.memory(), neighbor.memory(), wall.memory()};

  // The left half is hot: heat is temperature x area.
  diagram.enqueue(positions.memory(), nullptr, n, measures.memory(), status.memory());
  std::vector<float> heat(n);
  const std::vector<float> areas = measures.read(queue);
  for (cl_uint i = 0; i < n; ++i) heat[i] = start[2 * i] < 0.5F ? areas[4 * i] : 0;
  const Summary before(heat, areas);
  const Numbers<float> even(context, n, heat), odd(context, n);

  cl_kernel conduct = clCreateKernel(program, "conduct", nullptr),
            move = clCreateKernel(program, "move", nullptr);
  const cl_float conduction = 0.02F / static_cast<float>(n), motion = 1e-3F;  // of a step; stable
  for (int k = 0; k < steps; ++k) {
    diagram.enqueue(positions.memory(), nullptr, n, {measures.memory(), status.memory(), rows});
    enqueue(queue, conduct, n, n, room, conduction, positions.memory(), measures.memory(), status.memory(),
            offset.memory(), neighbor.memory(), wall.memory(), (k % 2 == 0 ? even : odd).memory(),
            (k % 2 == 0 ? odd : even).memory(), trouble.memory());
    if (k + 1 < steps) enqueue(queue, move, n, n, motion, positions.memory(), measures.memory());
  }
  clReleaseKernel(conduct);
  clReleaseKernel(move);

  const Summary after((steps % 2 == 0 ? even : odd).read(queue), measures.read(queue));
  std::printf("%d steps of %u cells on %s: heat %.5f and %.5f, temperatures differ by %.3f and %.3f\n", steps,
              n, device.info().name.c_str(), before.heat, after.heat, before.spread, after.spread);
  return trouble.read(queue)[0] == 0 && std::abs(after.heat - before.heat) < 1e-4 * before.heat &&
         after.spread < 0.8 * before.spread;
}

}  // namespace

int main() try {
  cl_platform_id platform = nullptr;
  cl_device_id device = nullptr;
  require(clGetPlatformIDs(1, &platform, nullptr),
          "finding OpenCL (on Debian: apt-get install pocl-opencl-icd)");
  require(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, nullptr), "finding a device");
  cl_int status = CL_SUCCESS;
  cl_context context = clCreateContext(nullptr, 1, &device, nullptr, nullptr, &status);
  require(status, "creating a context");
  cl_command_queue queue = clCreateCommandQueue(context, device, 0, &status);
  require(status, "creating a queue");
  const char* source = kernels;
  cl_program program = clCreateProgramWithSource(context, 1, &source, nullptr, &status);
  require(status, "creating a program");
  require(clBuildProgram(program, 1, &device, nullptr, nullptr, nullptr), "compiling the kernels");
  const bool right = simulate(context, queue, program, 1000, 1000);
  clReleaseProgram(program);
  clReleaseCommandQueue(queue);
  clReleaseContext(context);
  return right ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
