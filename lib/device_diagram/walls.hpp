/// \file
/// The walls and boundary walls of a DeviceDiagram, from pieces to rows.
#pragma once

#include <powercell/opencl.hpp>

#include "lib/device_diagram/facets.hpp"
#include "lib/pairs/device_pairs.hpp"
#include "lib/periodic/device_images.hpp"
#include "lib/primitives/scan.hpp"

namespace powercell {

/// A store of the walls of pieces and of their parts of the domain's boundary, which the clip kernel fills,
/// and the rows made of them in the caller's memory (docs/decisions.md, "Walls in device memory"). Enqueues
/// without waiting. Memory grows as needed and is reused.
class DeviceWalls {
 public:
  /// So that pieces without room cannot bring the number of entries beyond 32 bits.
  static constexpr std::uint32_t most_entries = 0x80000000u;

  /// Builds the kernels.
  /// \param facets   must outlive this
  /// \param defines  of kernels that hold no cell
  DeviceWalls(const std::shared_ptr<cl::Context>& context, const DeviceFacets& facets,
              const std::vector<std::string>& defines, std::size_t real_bytes);

  /// Makes room for `entries` faces of `pairs` pieces of n seeds, and empties the store.
  /// \param faces   which are stored, a sum of FACES_...
  /// \param images  of a periodic domain, kept until the next call; else null
  void begin(cl_uint faces, std::uint32_t entries, std::uint32_t pairs, std::uint32_t n,
             const DeviceImages* images);
  /// Makes room for none: the clip kernel then computes none.
  void begin_without();
  /// Those of the clip kernel (kernels/device_diagram/clip_pairs.cl).
  void append_store(cl::Kernel& kernel) const;
  /// Makes rows of the stored faces, before the seeds' statuses are known: pieces without room become
  /// PIECE_FULL.
  /// \param to  where walls are stored
  void gather(const DeviceSeeds& seeds, const DevicePairs& pairs, cl_mem pair_status, std::uint32_t n,
              const DeviceAdjacency& to);
  /// Combines both sides of each wall, and writes the rows to the caller's memory with room for `capacity`
  /// entries.
  /// \param status  final, of each seed in input order
  void write(const DeviceSeeds& seeds, cl_mem status, cl_mem frame, std::uint32_t n,
             const DeviceAdjacency& to, std::uint32_t capacity, cl_event* done);
  /// The same of the facets of the domain, which have one side.
  void write_facets(cl_mem status, cl_mem frame, std::uint32_t n, const DeviceBoundaryWalls& to,
                    std::uint32_t capacity, cl_event* done);

 private:
  const DeviceFacets& facets_;
  std::size_t real_bytes_;
  cl_uint faces_ = 0;
  std::uint32_t entries_ = 0;
  const DeviceImages* images_ = nullptr;
  cl::Kernel gather_, match_, write_, size_facets_, write_facets_;
  ExclusiveScan scan_;
  cl::Buffer<std::uint32_t> used_, piece_first_, piece_size_;  // the store, by pair
  cl::Buffer<std::uint32_t> neighbor_, from_, next_;           // by entry
  cl::Buffer<std::int32_t> image_;                             // the same, where there are images
  cl::RawBuffer wall_, matched_;                               // by entry
  cl::Buffer<std::uint32_t> row_first_, row_size_, facet_size_, last_extra_;  // by seed
};

}  // namespace powercell
