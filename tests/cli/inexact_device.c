/* Preloaded, it stands for a device whose double precision divides inexactly: of the results that the
   self-test reads (lib/cl/self_test.cpp), 7 doubles for each of 1024 items, it moves the first quotient. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stddef.h>

typedef int (*read_t)(void*, void*, unsigned, size_t, size_t, void*, unsigned, const void*, void*);

int clEnqueueReadBuffer(void* queue, void* buffer, unsigned blocking, size_t offset, size_t bytes, void* to,
                        unsigned waits, const void* wait_list, void* event) {
  const read_t real = (read_t)dlsym(dlopen("libOpenCL.so.1", RTLD_NOW), "clEnqueueReadBuffer");
  const int status = real(queue, buffer, blocking, offset, bytes, to, waits, wait_list, event);
  if (bytes == 1024 * 7 * sizeof(double)) ((double*)to)[2] *= 1 + 1e-12;
  return status;
}
