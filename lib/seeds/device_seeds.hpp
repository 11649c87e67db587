/// \file
/// The caller's seeds in device memory: checked, wrapped into a periodic domain, packed and ordered there.
#pragma once

#include <cstdint>
#include <optional>

#include "lib/cl/program.hpp"
#include "lib/domain/frame.hpp"
#include "lib/domain/period.hpp"
#include "lib/primitives/radix_sort.hpp"

namespace powercell {

/// Wraps seeds to the positions that Period::wrap finds, bit by bit. Enqueues without waiting.
class DeviceWrap {
 public:
  /// Uploads the lattice and builds the kernel.
  /// \param defines  Variant::defines()
  DeviceWrap(const std::shared_ptr<cl::Context>& context, const std::vector<std::string>& defines,
             const Period& period, const Frame& host_frame);

  /// As DeviceSeeds::enqueue.
  /// \param packed  written: seed_t
  /// \param status  written: SEED_OK or _INVALID
  void enqueue(cl_mem frame, cl_mem positions, cl_mem weights, std::uint32_t count, cl_mem packed,
               cl_mem status);

  cl::Buffer<std::int64_t> period;  ///< PERIOD_... of kernels/layout.h
  cl::Buffer<std::int64_t> place;   ///< by seed as given: its coordinates as integers (kernels/seeds/wrap.cl)
  /// By seed as given, 3 each: from the wrapped seed, in the vectors as given.
  cl::Buffer<std::int32_t> shift;

 private:
  std::size_t dimension_;
  cl::Kernel wrap_;
};

/// Seeds by rank, like SeedSet on the host: along a Hilbert curve, equal positions side by side. Invalid
/// seeds and duplicates keep a rank, since the host does not know how many there are; their weight is so low
/// that they affect no cell (kernels/base/point.cl). Enqueues without waiting.
class DeviceSeeds {
 public:
  /// Builds the kernels.
  /// \param defines  Variant::defines() for the precision and dimension
  /// \param period      of a periodic domain, into which seeds are wrapped; else null
  /// \param host_frame  the numbers of `frame` below
  DeviceSeeds(const std::shared_ptr<cl::Context>& context, const std::vector<std::string>& defines,
              bool float32, const Period* period, const Frame& host_frame);

  /// \param frame      FRAME_SIZE reals (kernels/layout.h)
  /// \param positions  count x d reals
  /// \param count  at least 1
  /// \param weights    count reals, or null for zeros
  void enqueue(cl_mem frame, cl_mem positions, cl_mem weights, std::uint32_t count);

  cl::RawBuffer points;             ///< seed_t by rank
  cl::Buffer<std::uint32_t> order;  ///< by rank: index of the seed as given
  cl::Buffer<std::uint32_t> state;  ///< by rank: SEED_OK, _DUPLICATE, _MERGED or _INVALID
  std::optional<DeviceWrap> wrap;   ///< in a periodic domain

 private:
  void pack(cl_mem frame, cl_mem positions, cl_mem weights, std::uint32_t count);
  void find_box(std::uint32_t count);
  void sort_by(int kind, std::uint32_t count, unsigned bits);

  bool float32_;
  cl::Kernel pack_, box_, grid_, number_, keys_kernel_, place_;
  RadixSort sort_;
  cl::RawBuffer packed_, boxes_, grid_box_, keys_;
  cl::Buffer<std::uint32_t> status_;
};

}  // namespace powercell
