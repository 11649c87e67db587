/* A diagram between kernels of the caller, in C: seeds and measures are buffers in the caller's OpenCL
 * context, all commands go to the caller's queue, and nothing is copied to the host in between. */
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <math.h>
#include <powercell_opencl.h>
#include <stdlib.h>

#include "c_check.h"

#define CHECK_CL(call)                                \
  do {                                                \
    if ((call) != CL_SUCCESS) {                       \
      fprintf(stderr, "an OpenCL call has failed\n"); \
      return 1;                                       \
    }                                                 \
  } while (0)

enum { n = 1000 };

static cl_float positions_host[3 * n], rows[5 * n]; /* volume, centroid x y z, second moment */

int main(void) {
  const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
  cl_platform_id platform = NULL;
  cl_device_id id = NULL;
  cl_context context = NULL;
  cl_command_queue queue = NULL;
  cl_mem positions = NULL, measures = NULL, status = NULL;
  cl_event seeds_ready = NULL, diagram_done = NULL;
  pc_device* device = NULL;
  pc_domain* domain = NULL;
  pc_device_diagram* diagram = NULL;
  pc_options options;
  unsigned random = 1;
  double volume = 0;
  int i;

  CHECK_CL(clGetPlatformIDs(1, &platform, NULL));
  CHECK_CL(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &id, NULL));
  context = clCreateContext(NULL, 1, &id, NULL, NULL, NULL);
  queue = context ? clCreateCommandQueue(context, id, 0, NULL) : NULL;
  CHECK(pc_device_from_queue(queue, &device)); /* retains queue and context */
  CHECK(pc_domain_box(low, high, 3, &domain));
  CHECK(pc_options_init(&options, sizeof options));
  options.precision = PC_FLOAT32; /* so the buffers hold cl_float */
  CHECK(pc_device_diagram_create(device, domain, &options, &diagram));

  for (i = 0; i < 3 * n; ++i) {
    random = random * 1664525u + 1013904223u;
    positions_host[i] = (cl_float)((random >> 8) / 16777216.0);
  }
  positions = clCreateBuffer(context, CL_MEM_READ_ONLY, sizeof positions_host, NULL, NULL);
  measures = clCreateBuffer(context, CL_MEM_READ_WRITE, sizeof rows, NULL, NULL);
  status = clCreateBuffer(context, CL_MEM_READ_WRITE, n * sizeof(cl_uint), NULL, NULL);

  /* Here a kernel of the caller would write the seeds; a non-blocking copy stands in for it. */
  CHECK_CL(clEnqueueWriteBuffer(queue, positions, CL_FALSE, 0, sizeof positions_host, positions_host, 0, NULL,
                                &seeds_ready));
  CHECK(pc_device_diagram_enqueue(diagram, positions, NULL, n, measures, status, 1, &seeds_ready,
                                  &diagram_done));
  /* Here a kernel of the caller would use the measures; a blocking read stands in for it. */
  CHECK_CL(clEnqueueReadBuffer(queue, measures, CL_TRUE, 0, sizeof rows, rows, 1, &diagram_done, NULL));
  for (i = 0; i < n; ++i) volume += rows[5 * i];
  printf("%d cells on %s in the caller's queue and buffers, volume %.4f\n", n, pc_device_name(device),
         volume);

  clReleaseEvent(seeds_ready);
  clReleaseEvent(diagram_done);
  clReleaseMemObject(positions);
  clReleaseMemObject(measures);
  clReleaseMemObject(status);
  pc_device_diagram_destroy(diagram);
  pc_domain_destroy(domain);
  pc_device_destroy(device);
  clReleaseCommandQueue(queue);
  clReleaseContext(context);
  return fabs(volume - 1) < 1e-4 ? 0 : 1;
}
