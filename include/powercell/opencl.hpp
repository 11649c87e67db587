/// \file
/// For callers with their own OpenCL objects. The only public header that needs the OpenCL headers.
#pragma once

#ifndef CL_TARGET_OPENCL_VERSION
#define CL_TARGET_OPENCL_VERSION 120
#endif
#include <CL/cl.h>

#include <cstdint>
#include <memory>
#include <powercell/device.hpp>
#include <powercell/domain.hpp>
#include <powercell/options.hpp>

namespace powercell {

/// A device that works in the caller's context, on the caller's in-order queue. Both are retained.
/// \throw Error invalid_argument for a null or out-of-order queue; self_test_failed, build_failed, opencl
POWERCELL_API Device device_from_queue(cl_command_queue queue);

/// What became of a seed, as DeviceDiagram writes it: the values of SeedStatus, and two more.
enum class DeviceSeedStatus : std::uint32_t {
  ok = 0,          ///< the cell has a positive measure
  hidden = 1,      ///< the cell restricted to the domain is empty
  duplicate = 2,   ///< another seed at the same position has a larger weight, or the same and a lower index
  invalid = 3,     ///< NaN, infinity, or so large that its square is not finite; the others are as without it
  unfinished = 4,  ///< its cell needs what only the host can do (see DeviceDiagram); the others are right
};

/// Power diagrams from device memory to device memory: seeds come as cl_mem, measures go as cl_mem, and
/// nothing is copied to the host in between. Calls enqueue on the queue of the device
/// (device_from_queue) and return without waiting for it (but see set_pair_capacity).
///
/// Scratch memory is kept from call to call and reused in the order of the queue. Not thread-safe; use one
/// object for each thread. Results do not depend on sizes of work-groups and launches, bit for bit.
///
/// What the host does for Diagram is done on the device here, but for the last resort: a cell of more than
/// about 128 faces within one region, or one whose cuts rounding has made contradictory (seen in single
/// precision only), is reported as `unfinished` and its measures are NaN, never a part of the cell.
/// Diagram gives those too. For the same reason decisions are those of Decisions::fast: of a cell that is
/// empty or not by less than rounding either may be told; measures differ by rounding.
class POWERCELL_API DeviceDiagram {
 public:
  /// Uploads the domain and builds the kernels; this waits.
  /// \param options  `precision` is that of the caller's arrays and of the computation; `chunk_pairs` is
  ///   the most pairs of one kernel launch; what concerns the host (`threads`, `progress`, `decisions`,
  ///   `certify`) is not used
  /// \throw Error no_fp64; unsupported (Neighbors::flann, which works on the host; a domain whose size is
  ///   not in the range of the precision); build_failed, opencl
  DeviceDiagram(Device device, Domain domain, Options options = {});
  DeviceDiagram(DeviceDiagram&&) noexcept;
  DeviceDiagram& operator=(DeviceDiagram&&) noexcept;
  ~DeviceDiagram();

  const Device& device() const;
  const Domain& domain() const;
  Precision precision() const;  ///< float64: `real` below is cl_double; float32: cl_float

  /// For domains of several convex regions (Domain::region_count): room for this many pairs of a seed and a
  /// region that may meet, 20 bytes and 2 + d reals each. If there are more, the seeds whose pairs find no
  /// room are `unfinished`. A few pairs for each seed and each region suffice in most cases. With 0, the
  /// default, enqueue() makes room for as many as there are. It must read one number of 8 bytes to know, so
  /// it waits for the queue and for the wait list; this is the only case in which it does.
  void set_pair_capacity(std::uint32_t pairs);

  /// Enqueues one diagram of n seeds in d coordinates, in the caller's units. All buffers are the
  /// caller's, of the context of the device, and must not change between the wait list and `done`.
  /// \param positions  read: n x d reals, row-major
  /// \param weights    read: n reals; null means all zero
  /// \param n          at most 2^30; with 0 the buffers may be null
  /// \param measures   written: n x (2 + d) reals, row-major: mass (length^d' for cells of dimension d'),
  ///   centroid (d coordinates; NaN without a cell), second moment about the seed (length^(d'+2)).
  ///   0, NaN..., 0 for hidden and duplicate seeds; all NaN for invalid and unfinished ones
  /// \param status     written: n cl_uint, each a DeviceSeedStatus
  /// \param wait_count, wait_list  events that must be complete before the first command runs
  /// \param done       if not null: the event of the last command, for the caller to release
  /// The queue is flushed. An exception hands out no event, may leave commands behind that still write
  /// scratch memory or results, and leaves the diagram as it was: it can be called again.
  /// \throw Error invalid_argument (a buffer that is too small or of another context, which),
  ///   out_of_device_memory, opencl
  void enqueue(cl_mem positions, cl_mem weights, std::uint32_t n, cl_mem measures, cl_mem status,
               cl_uint wait_count = 0, const cl_event* wait_list = nullptr, cl_event* done = nullptr);

  struct State;  ///< library-internal

 private:
  std::unique_ptr<State> state_;
};

}  // namespace powercell
