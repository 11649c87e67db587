/** \file
 * OpenCL devices: the list of them, and the one that a diagram runs on.
 */
#ifndef POWERCELL_C_DEVICE_H
#define POWERCELL_C_DEVICE_H

#include <powercell/c/options.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pc_device pc_device; /**< an OpenCL device with its context, queue and programs; or a group */

typedef enum pc_device_kind {
  PC_DEVICE_CPU = 0,
  PC_DEVICE_GPU,
  PC_DEVICE_ACCELERATOR,
  PC_DEVICE_OTHER
} pc_device_kind;

/** "cpu", "gpu", "accelerator" or "other"; "unknown" for other numbers. Static storage. */
POWERCELL_API const char* pc_device_kind_name(pc_device_kind kind);

/** An OpenCL device of this machine. */
typedef struct pc_device_info {
  int platform; /**< index of the platform, in the order of the ICD loader */
  int device;   /**< index of the device within its platform */
  const char* platform_name;
  const char* name;
  const char* vendor;
  const char* driver_version;
  const char* opencl_c_version;
  const char* selector; /**< "P:D", as pc_device_create() accepts it */
  pc_device_kind kind;
  int fp64; /**< not 0: has double precision in kernels */
  unsigned compute_units;
  unsigned clock_mhz;
  uint64_t memory_bytes;       /**< global memory */
  uint64_t largest_allocation; /**< largest single buffer, bytes */
  size_t max_work_group_size;
  int unified_memory; /**< not 0: its memory is the host's, as that of CPUs and integrated GPUs is */
} pc_device_info;

/** A device that OpenCL lists and that cannot be used, or a platform that cannot list its devices. */
typedef struct pc_unusable_device {
  int platform;
  int device;         /**< index within the platform; -1: the whole platform */
  const char* name;   /**< of the device or platform */
  const char* reason; /**< one line */
} pc_unusable_device;

/** All devices of all platforms, in the order of the ICD loader. */
typedef struct pc_device_list {
  size_t count;
  const pc_device_info* const* devices; /**< count pointers */
  size_t unusable_count;                /**< of pc_device_list_create(); else 0 */
  const pc_unusable_device* const* unusable;
} pc_device_list;

/** Lists the devices of this machine, and apart from them those that cannot be used; none without a platform
 * or an OpenCL loader. PC_UNSUPPORTED in a process that was forked after OpenCL was used. */
POWERCELL_API pc_status pc_device_list_create(const pc_device_list** list);
POWERCELL_API void pc_device_list_destroy(const pc_device_list* list);

/** Opens the device that `selector` names ("P:D", part of a name, "cpu", "gpu"); NULL or "": the default.
 * Several of these with commas between name a group of them, "all" one of all devices, the best first. */
POWERCELL_API pc_status pc_device_create(const char* selector, pc_device** device);
/** Several devices as one. A diagram shares the clipping of its cells out to all of them by their speeds, and
 * does what is not shared on the first. \param devices  `count` opened devices, each once; groups too. They
 * may be destroyed before the group */
POWERCELL_API pc_status pc_device_group_create(const pc_device* const* devices, size_t count,
                                               pc_device** group);
/** The devices of a group, in their order; of a single device itself. */
POWERCELL_API pc_status pc_device_members(const pc_device* device, const pc_device_list** list);
POWERCELL_API void pc_device_destroy(pc_device* device);
/** The device's name, of a group that of the first; owned by the handle. NULL for a NULL handle. */
POWERCELL_API const char* pc_device_name(const pc_device* device);
/** What the device is, of a group the first; lasts as long as the handle. */
POWERCELL_API pc_status pc_device_info_view(const pc_device* device, const pc_device_info** info);
/** Seconds spent on compiling kernels since the device was opened; 0 if all came from the cache. The sum of a
 * group. */
POWERCELL_API pc_status pc_device_build_seconds(const pc_device* device, double* seconds);

/** Compilation of kernels in this process, on all devices and in all threads. Any pointer may be NULL.
 * \param running            whether a kernel is being compiled now: 1 or 0
 * \param seconds            wall-clock time spent so far
 * \param processor_seconds  of this process meanwhile */
POWERCELL_API pc_status pc_kernel_builds(int* running, double* seconds, double* processor_seconds);

/** Measures the best rates that a device reaches, in about a second and up to 512 MiB of device memory.
 * Any pointer may be NULL.
 * \param copied_bytes  bytes read plus bytes written per second while copying a large buffer
 * \param operations    multiplications plus additions per second; a fused one counts as two */
POWERCELL_API pc_status pc_device_rates(const pc_device* device, pc_precision precision, double* copied_bytes,
                                        double* operations);

/** Measures, in a few milliseconds, what a call costs however small its work is: seconds on the host, the
 * least of many. Any pointer may be NULL. \param launch    enqueuing a kernel of one work-item and waiting
 * for it \param transfer  reading one number from device memory */
POWERCELL_API pc_status pc_device_latencies(const pc_device* device, double* launch, double* transfer);

/** Measures how many bytes a second go from host memory to device memory and back, `bytes` at a time: on the
 * host from the call to its end, the best of several. Takes a fifth of a second, or nine transfers each way
 * if these take longer. Either of the last two pointers may be NULL. */
POWERCELL_API pc_status pc_device_transfers(const pc_device* device, size_t bytes, double* to_device,
                                            double* to_host);

#ifdef __cplusplus
}
#endif
#endif
