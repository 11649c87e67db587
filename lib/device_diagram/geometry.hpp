/// \file
/// The geometry of a DeviceDiagram, from pieces to rows.
#pragma once

#include <powercell/opencl.hpp>
#include <vector>

#include "lib/device_diagram/facets.hpp"
#include "lib/neighbors/tree_blocks.hpp"
#include "lib/pairs/device_pairs.hpp"
#include "lib/periodic/device_images.hpp"
#include "lib/primitives/scan.hpp"
#include "lib/scene/variant.hpp"

namespace powercell {

/// How much fits the caller's buffers of DeviceCells.
struct CellRooms {
  std::uint64_t pieces = 0, vertices = 0, faces = 0, loop = 0;
};

/// Clips the pairs again with the kernel that Diagram has (kernels/clip/by_tree.cl), some at a time, into
/// rows of a fixed room each: once to count what cells have, and once more to copy it to the caller's memory.
/// So there is no memory for the geometry but the caller's. Enqueues without waiting. Memory grows as needed
/// and is reused.
class DeviceGeometry {
 public:
  /// Builds the kernels, which waits.
  /// \param domain, facets  must outlive this
  /// \param variant  precision, dimensions and lanes
  /// \param most     pairs of a launch
  /// \throw Error build_failed, self_test_failed, opencl, out_of_device_memory
  DeviceGeometry(const DomainBuffers& domain, const DeviceFacets& facets, const Variant& variant,
                 std::uint64_t most);

  /// A diagram whose pairs are clipped.
  struct Clipped {
    std::uint32_t n;  ///< seeds
    const DeviceSeeds& seeds;
    const DevicePairs& pairs;
    const DeviceImages* images;  ///< of a periodic domain; else null
    const TreeBlocks& blocks;
    TreeBlocks::Tree tree;
    cl_mem pair_status;  ///< changed for pieces that are not what they were: then they are not finished
    cl_mem moments;      ///< by pair: written with what they are
  };
  /// Counts what the pieces of each pair have.
  void count(const Clipped& from);
  /// Writes the cells.
  /// \param status  final, of each seed in input order
  void write(const Clipped& from, cl_mem status, cl_mem frame, cl_mem positions, const DeviceCells& to,
             const CellRooms& room);

 private:
  /// The program of one capacity, and the rows that it writes.
  struct Rows {
    Rows(const DomainBuffers& domain, Variant variant);
    void reserve(std::uint32_t rows);

    Variant variant;
    cl::Kernel clip;
    std::uint32_t count = 0;  ///< of a launch
    cl::Buffer<std::uint32_t> active, status, faces, vertices, link;
    cl::Buffer<std::int32_t> border;
    cl::RawBuffer wall, vertex;
  };

  std::uint32_t rows_that_fit(const Variant& variant, std::uint32_t pairs) const;
  /// Clips the rows of the pairs from `first` on.
  void clip(std::size_t capacity, std::uint32_t first, const Clipped& from, bool placed);
  void write_rows(const Rows& rows, const Clipped& from, cl_mem frame, cl_mem positions,
                  const DeviceCells& to);

  const DomainBuffers& domain_;
  const DeviceFacets& facets_;
  std::uint64_t most_;
  cl::Kernel choose_, count_, size_, place_, write_;
  ExclusiveScan scan_;
  Compaction compaction_;
  std::vector<Rows> rows_;                                             // by number of the capacity
  cl::Buffer<std::uint32_t> faces_, vertices_, list_, found_;          // by pair; those of the next capacity
  cl::Buffer<std::uint64_t> place_piece_, place_vertex_, place_face_;  // by pair
  cl::Buffer<std::uint64_t> cell_vertices_, cell_faces_;               // by seed
};

}  // namespace powercell
