/// \file
/// For callers with OpenCL objects of their own. The only public header that needs the OpenCL headers.
#pragma once

#include <powercell/c/opencl_types.h>

#include <cstdint>
#include <memory>
#include <powercell/device.hpp>
#include <powercell/domain.hpp>
#include <powercell/options.hpp>

namespace powercell {

/// A device in the caller's context, on the caller's in-order queue. Both are retained.
/// \throw Error invalid_argument for a null or out-of-order queue; self_test_failed, build_failed, opencl
POWERCELL_API Device device_from_queue(cl_command_queue queue);

/// The function of OpenCL that the library calls: that of the process if it has one, else of the system's
/// loader, which the first call opens. For programs that call OpenCL but are to start where there is none;
/// they link no loader.
/// \param name  "clCreateBuffer" and so on
/// \return null if there is no loader, or none with this function
POWERCELL_API void* opencl_function(const char* name);

/// The state of a seed, as DeviceDiagram writes it: the values of SeedStatus, and two more.
enum class DeviceSeedStatus : std::uint32_t {
  ok = 0,         ///< the cell has a positive measure
  hidden = 1,     ///< the cell restricted to the domain is empty
  duplicate = 2,  ///< another seed at the same position has a larger weight, or the same and a lower index
  /// NaN, infinity, or so large that its square is not finite; in a periodic domain also more than 2^28
  /// periods outside. It does not affect the others.
  invalid = 3,
  unfinished = 4,  ///< only the host can compute its cell (see DeviceDiagram); the others are right
};

/// The pairs of cells that share a wall inside the domain, as compressed sparse rows in buffers of the
/// caller, of the context of the device. As Adjacency: j is in row i with the same measure as i in row j, in
/// a periodic domain with the opposite shift. The two sides of a wall are averaged; a wall that only one cell
/// has is left out as rounding if it is small beside the largest wall of both (10^-9 in double precision,
/// 10^-3 in single), else both cells have it. Only seeds whose status is ok have walls.
struct DeviceAdjacency {
  /// Written: n + 1 cl_uint; row i is [offset[i], offset[i+1]). Right also where the next two are too small.
  cl_mem offset = nullptr;
  cl_mem neighbor = nullptr;  ///< written: cl_uint each, ascending within a row
  /// Written: a real each, the length (polygon, surface) or area (volume) of the wall. There is room for as
  /// many entries as fit all buffers. Rows that end beyond it are not written, the others are whole.
  cl_mem wall = nullptr;
  /// In a periodic domain, where it is needed; else null. Written: 3 cl_int an entry, the image of the
  /// neighbour in periods of the domain, as Adjacency::shift. A seed may occur several times in a row, with
  /// ascending shifts, and so may the row's own seed.
  cl_mem shift = nullptr;
};

/// The parts of the domain's boundary that belong to each cell, as compressed sparse rows in buffers of the
/// caller, of the context of the device. As BoundaryWalls, with the numbers of facets that it has; closed
/// surfaces and periodic axes have none. Only seeds whose status is ok have any. Those of the cells that are
/// not on the list of DeviceUncertain have the facets that they have with Decisions::exact.
struct DeviceBoundaryWalls {
  /// Written: n + 1 cl_uint; row i is [offset[i], offset[i+1]). Right also where the next two are too small.
  cl_mem offset = nullptr;
  cl_mem facet = nullptr;  ///< written: cl_uint each, ascending within a row
  /// Written: a real each, the length (polygon, surface) or area (volume) of the part. There is room for as
  /// many entries as fit both buffers. Rows that end beyond it are not written, the others are whole.
  cl_mem measure = nullptr;
};

/// The seeds whose cells only the host can decide, in buffers of the caller, of the context of the device:
/// those that are unfinished, and those of whose cells rounding may have decided the shape. Every other cell
/// is there or hidden as Decisions::exact has it, and has the neighbours that it has there, except that walls
/// with cells of the list may be missing, or be there although they should not. Where numbers underflow,
/// seeds that are different may be one to the device: those that it has set aside for that are on the list as
/// well, and nothing is certain about the others.
struct DeviceUncertain {
  cl_mem count = nullptr;  ///< written: one cl_uint, how many they are, also where they do not fit
  /// Written: cl_uint each, indices of seeds, ascending; as many as fit the buffer, from the first on.
  cl_mem seeds = nullptr;
};

/// The geometry of the cells as convex pieces, as Cells has it, in buffers of the caller, of the context of
/// the device. Only seeds whose status is ok have pieces: one for each region of the domain that the cell
/// meets, in an order that depends on the seeds and the domain alone. Faces are those that each cell was
/// clipped to: they are not matched with those of its neighbours, as DeviceAdjacency is. Cells of random
/// seeds in space have 15.5 faces and 27 vertices on average, in the plane 6; cut into several regions, more.
///
/// If some buffers are too small, then the first cells are written, as many as fit all of them, and nothing
/// of the others; `counts` and `cell_offset` are right all the same.
struct DeviceCells {
  /// Written: 4 cl_ulong, how many pieces, vertices, faces and entries of `loop` all cells have, also where
  /// they do not fit.
  cl_mem counts = nullptr;
  cl_mem cell_offset = nullptr;  ///< written: n + 1 cl_ulong; cell i owns [cell_offset[i], cell_offset[i+1])
  cl_mem region = nullptr;       ///< written: a cl_uint a piece, the region of the domain it lies in
  cl_mem vertex_offset = nullptr;  ///< written: cl_ulong, one more than pieces
  cl_mem vertices = nullptr;     ///< written: d reals a vertex, row-major; in a periodic domain near the seed
  cl_mem face_offset = nullptr;  ///< written: cl_ulong, one more than pieces
  cl_mem border = nullptr;       ///< written: 2 cl_uint a face, as Border: the kind and the index
  /// In a periodic domain, where it is needed; else null. Written: 3 cl_int a face, as Cells::shift.
  cl_mem shift = nullptr;
  /// These two for cells of dimension 3, where they are needed; else null.
  cl_mem loop_offset = nullptr;  ///< written: cl_ulong, one more than faces
  cl_mem loop = nullptr;         ///< written: cl_uint, indices from 0 within the vertices of the piece
};

/// What a diagram writes, in buffers of the caller, of the context of the device.
struct DeviceResults {
  /// Written: n x (2 + d) reals, row-major: mass (length^d' for cells of dimension d'), centroid (d
  /// coordinates; NaN without a cell), second moment about the seed (length^(d'+2)). 0, NaN..., 0 for hidden
  /// and duplicate seeds; all NaN for invalid and unfinished ones. With a density: set_density().
  cl_mem measures = nullptr;
  cl_mem status = nullptr;                  ///< written: n cl_uint, each a DeviceSeedStatus
  DeviceAdjacency adjacency = {};           ///< where it is wanted, in the same pass; else null
  DeviceUncertain uncertain = {};           ///< where it is wanted; else null
  DeviceCells cells = {};                   ///< where it is wanted, in two more passes; else null
  DeviceBoundaryWalls boundary_walls = {};  ///< where it is wanted, in the same pass; else null
};

/// Power diagrams from device memory to device memory: seeds, measures, walls and geometry are cl_mem, and
/// nothing is copied to the host in between. Calls enqueue on the queue of the device (device_from_queue) and
/// return without waiting for it, with two exceptions (set_pair_capacity, set_image_capacity); the first call
/// that asks for cells builds their kernels besides, which waits.
///
/// Scratch memory is kept from call to call and reused in the order of the queue. Not thread-safe; use one
/// object per thread. Results do not depend on the sizes of work-groups and launches, bit for bit.
///
/// enqueue() has the device do all the work, without the host as a last resort: a cell of more than about 128
/// faces within one region, or one whose cuts rounding has made contradictory (seen in single precision
/// only), is reported as `unfinished` with NaN for measures, never as a part of the cell. Decisions are those
/// of Decisions::fast: a cell whose existence depends on rounding may be reported as present or as hidden,
/// and measures differ by rounding. DeviceUncertain lists all these cells, and repair() computes them
/// exactly.
///
/// In periodic domains seeds are wrapped to the positions that Diagram computes with (Domain::wrapped), and
/// those at the same position are duplicates. Centroids are near the seeds as given. A cell that reaches
/// farther than those of random seeds do may need images that were not made: it is `unfinished`, and on the
/// list.
class POWERCELL_API DeviceDiagram {
 public:
  /// Uploads the domain and builds the kernels; this waits.
  /// \param options  `precision` is that of the caller's arrays and of the computation; `chunk_pairs` is
  ///   the most pairs of one kernel launch; `threads` and `progress` are those of repair(); `decisions` and
  ///   `certify` are ignored
  /// \throw Error no_fp64; unsupported (a group of devices; Neighbors::flann, which works on the host; a
  ///   domain whose size is not in the range of the precision); build_failed, opencl
  DeviceDiagram(Device device, Domain domain, Options options = {});
  DeviceDiagram(DeviceDiagram&&) noexcept;
  DeviceDiagram& operator=(DeviceDiagram&&) noexcept;
  ~DeviceDiagram();

  const Device& device() const;
  const Domain& domain() const;
  Precision precision() const;  ///< float64: `real` below is cl_double; float32: cl_float

  /// For domains of several convex regions (Domain::region_count): the room for candidate pairs of a seed and
  /// a region, 20 bytes and 2 + d reals each. Seeds whose pairs exceed it are `unfinished`. A few pairs for
  /// each seed and each region suffice in most cases. With 0, the default, enqueue() makes room for all
  /// pairs: it reads their number, 8 bytes, and for that waits for the queue and the wait list.
  void set_pair_capacity(std::uint32_t pairs);

  /// For periodic domains: the room for images of seeds behind the borders, about 170 bytes each. If there
  /// are more, all cells are `unfinished` but those that are hidden without them. Images are made of all
  /// seeds within a margin around the domain, which is twice the reach of the largest random cells, and up
  /// to 1.4 times that where weights differ: with s = (measure / n)^(1/d), 2 s cbrt((log n + 6) / 4.19) in
  /// space and 2 s sqrt((log n + 6) / 3.14) in the plane. Of even seeds in a cube 10^5 have some 0.5 each and
  /// 10^6 some 0.2. With 0, the default, enqueue() makes room for all: it reads their number, 8 bytes, and
  /// for that waits for the queue and the wait list. It waits in no other case.
  void set_image_capacity(std::uint32_t images);

  /// The room for walls and boundary walls while rows are made of them, 12 bytes (in a periodic domain 16)
  /// and 2 reals each; at most 2^31. Cells whose walls do not fit are `unfinished`; which these are may
  /// change from call to call. With 0, the default, there is room for 8 walls a seed (cells of dimension 2)
  /// or 20 (3) in a domain of one region, else for 6 or 16 a pair; for boundary walls alone 2 or 4, else 4 or
  /// 8; and where these are wanted, for two for each facet of a region besides. Cells of random seeds have 6
  /// and 15.5 walls on average.
  void set_wall_capacity(std::uint32_t walls);

  /// A density for measures: they are then the integral of rho over each cell, that of rho x over it, and the
  /// integral of rho |x - p_i|^2, in place of those of 1. Where the mass is 0 the centroid is NaN.
  /// Statuses, walls, boundary walls, the list and geometry stay those of the cells alone: `ok` means that
  /// the cell has a positive area or volume, also where its mass is 0.
  ///
  /// rho is linear in each triangle or tetrahedron of the domain, as Density::nodal. Each enqueue() reads the
  /// values as they are then, so that kernels of the caller may change them between two of them. They are
  /// not checked on the host: a cell with a part in a region at a corner of which the value is negative, not
  /// finite or above 10^100 (single precision: 10^30) has NaN for all its measures, and the others are right.
  /// Takes 2 + d reals a pair besides, and 4 a region. The first call with a buffer builds kernels; this
  /// waits.
  /// \param values  read: a real for each vertex, in the order passed to Domain::surface or Domain::volume, a
  ///   buffer of the context of the device, which is retained until another one is set; null: no density
  /// \throw Error unsupported unless the domain is a mesh of triangles or tetrahedra; invalid_argument (a
  ///   buffer that is too small or of another context); build_failed, self_test_failed, out_of_device_memory,
  ///   opencl. The density is then as before.
  void set_density(cl_mem values);

  /// Enqueues one diagram of n seeds in d coordinates, in the caller's units. All buffers are the
  /// caller's, of the context of the device, and must not change between the wait list and `done`. Those that
  /// are written share no memory with any other, also as parts of one buffer (clCreateSubBuffer).
  /// \param positions  read: n x d reals, row-major
  /// \param weights    read: n reals; null means all zero
  /// \param n          at most 2^30; with 0 the buffers may be null
  /// \param measures   written: as in DeviceResults
  /// \param status     written: as in DeviceResults
  /// \param wait_count  how many events must be complete before the first command runs
  /// \param wait_list  these events
  /// \param done       if not null: the event of the last command, for the caller to release
  /// The queue is flushed. After an exception there is no event, commands may still be writing scratch memory
  /// or results, and the diagram can be used again.
  /// \throw Error invalid_argument (a buffer that is too small, of another context, or written and shared,
  /// which), out_of_device_memory, opencl
  void enqueue(cl_mem positions, cl_mem weights, std::uint32_t n, cl_mem measures, cl_mem status,
               cl_uint wait_count = 0, const cl_event* wait_list = nullptr, cl_event* done = nullptr);
  /// The same with all that is wanted.
  void enqueue(cl_mem positions, cl_mem weights, std::uint32_t n, const DeviceResults& results,
               cl_uint wait_count = 0, const cl_event* wait_list = nullptr, cl_event* done = nullptr);

  /// Computes the cells of the list results.uncertain as Diagram does with exact decisions, from all seeds,
  /// and puts them into the caller's results. Then every status, and the adjacency where it is given, is that
  /// of such a Diagram without the invalid seeds, and so are the boundary walls, and the pieces and faces of
  /// cells, where these are given; measures and vertices of the listed cells are the Diagram's, rounded to
  /// the precision, and those of the others differ from its by rounding. No cell is unfinished any more;
  /// invalid seeds stay invalid. With a density, which must be that of enqueue(), measures of the listed
  /// cells are its integrals over the exact cells.
  ///
  /// Waits for the queue, and works on the host: seeds, measures, statuses, rows and cells are read, and
  /// results are written back. Rows and cells may change their lengths, so all are written anew. The
  /// Diagram is kept for the next call; where the positions are the same, so are its order and tree.
  /// \param positions  as given to enqueue() before
  /// \param weights    as given to enqueue() before
  /// \param n          as given to enqueue() before
  /// \param results  as written by that call, with the list
  /// \return how many cells were computed: 0 where the list is empty, for which only its count is read; all
  ///   valid ones where seeds that are different were one to the device
  /// \throw Error invalid_argument (a buffer that is missing, too small or of another context; a list that is
  ///   too small for all uncertain seeds, rows for all entries, or buffers for all cells, in which case
  ///   enqueue() again with more room; a list that enqueue() has not written); out_of_device_memory, opencl,
  ///   interrupted. Results are changed only if writing them fails, in the end: then enqueue() again.
  std::uint32_t repair(cl_mem positions, cl_mem weights, std::uint32_t n, const DeviceResults& results);

  struct State;  ///< library-internal

 private:
  std::unique_ptr<State> state_;
};

}  // namespace powercell
