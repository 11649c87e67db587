/// \file
/// The images of seeds that bound the cells of a periodic domain, in device memory.
#pragma once

#include <cstdint>

#include "lib/primitives/scan.hpp"
#include "lib/seeds/device_seeds.hpp"

namespace powercell {

/// Like Images on the host: behind the seeds by rank, their images within a margin along a Hilbert curve. How
/// many these are is known to the device alone.
class DeviceImages {
 public:
  /// Uploads what it needs of the lattice and builds the kernels.
  /// \param defines  Variant::defines()
  DeviceImages(const std::shared_ptr<cl::Context>& context, const std::vector<std::string>& defines,
               const Period& period, const Frame& frame);

  /// Enqueues the search.
  /// \param seeds  of `count`, in order; at least one
  /// \param most  images to make room for, beyond which they are dropped; 0 to read how many there are, which
  ///   waits for the queue
  /// \throw Error opencl; out_of_device_memory, also if there are too many seeds and images
  void enqueue(const DeviceSeeds& seeds, std::uint32_t count, std::uint32_t most);

  /// Enqueues the proof for the cells of all seeds: those without become PIECE_MORE.
  /// \param reach  a real by rank, as clip kernels write it
  /// \param status  by rank: PIECE_...
  void prove(const DeviceSeeds& seeds, std::uint32_t count, cl_mem reach, cl_mem status);

  std::uint32_t total = 0;               ///< seeds and places for images
  cl::RawBuffer points;                  ///< seed_t by rank: seeds, images, and places that no image takes
  cl::Buffer<std::uint32_t> image_seed;  ///< per image: rank of its seed
  /// Per image: the number of its shift, minus that of the opposite one.
  cl::Buffer<std::int32_t> image_shift;
  /// Per number, from the least on: the shift in the vectors as given. Numbers are in the order of these.
  cl::Buffer<std::int32_t> shift_given;

 private:
  void find_margin(const DeviceSeeds& seeds, std::uint32_t count);
  void list(const DeviceSeeds& seeds, std::uint32_t count);
  std::uint32_t read_number(std::uint32_t count) const;

  std::uint32_t room_ = 0;  // for images
  cl::Kernel weights_, margin_kernel_, count_, list_, mark_, keys_kernel_, place_, prove_;
  ExclusiveScan scan_;
  RadixSort sort_;
  cl::RawBuffer extent_, grid_, of_tile_, margin_, images_;
  cl::Buffer<std::int32_t> shift_number_, number_;   // by place in the table; by image as listed
  cl::Buffer<std::uint64_t> offset_, keys_;          // by rank: of its images, with their number at the end
  cl::Buffer<std::uint32_t> order_, status_, seed_;  // by image as listed
};

}  // namespace powercell
