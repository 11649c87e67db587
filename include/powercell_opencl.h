/** \file
 * powercell for C programs with OpenCL objects of their own. The only C header that needs the OpenCL headers.
 */
#ifndef POWERCELL_OPENCL_H
#define POWERCELL_OPENCL_H

#include <powercell/c/device.h>
#include <powercell/c/domain.h>
#include <powercell/c/opencl_types.h>
#include <powercell/c/options.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A device in the caller's context, on the caller's in-order queue. Both are retained until
 * pc_device_destroy(). */
POWERCELL_API pc_status pc_device_from_queue(cl_command_queue queue, pc_device** device);

/** The function of OpenCL that the library calls: that of the process if it has one, else of the system's
 * loader, which the first call opens. For programs that call OpenCL but are to start where there is none;
 * they link no loader. NULL if there is no loader, or none with this function. \param name  "clCreateBuffer"
 * and so on */
POWERCELL_API void* pc_opencl_function(const char* name);

/** The state of a seed, as pc_device_diagram_enqueue() writes it: those of pc_seed_status, and two more. */
typedef enum pc_device_seed_status {
  PC_DEVICE_SEED_OK = 0,
  PC_DEVICE_SEED_HIDDEN,
  PC_DEVICE_SEED_DUPLICATE,
  PC_DEVICE_SEED_INVALID,   /**< NaN, infinity or too large; it does not affect the others */
  PC_DEVICE_SEED_UNFINISHED /**< only the host can compute its cell; the others are right */
} pc_device_seed_status;

/** Power diagrams from device memory to device memory, without a copy to the host. powercell::DeviceDiagram
 * says which cells are left to the host. */
typedef struct pc_device_diagram pc_device_diagram;

/** Uploads the domain and builds the kernels; this waits.
 * \param device   of pc_device_from_queue()
 * \param options  NULL for the defaults. `precision` is that of the caller's arrays; `threads` and `progress`
 *   are those of pc_device_diagram_repair(); `decisions` and `certify` are ignored */
POWERCELL_API pc_status pc_device_diagram_create(const pc_device* device, const pc_domain* domain,
                                                 const pc_options* options, pc_device_diagram** diagram);
POWERCELL_API void pc_device_diagram_destroy(pc_device_diagram* diagram);

/** The precision as chosen: reals are cl_double for PC_FLOAT64, cl_float for PC_FLOAT32. */
POWERCELL_API pc_status pc_device_diagram_precision(const pc_device_diagram* diagram,
                                                    pc_precision* precision);
/** Handles of the domain and the device that the diagram uses, for the caller to destroy. */
POWERCELL_API pc_status pc_device_diagram_domain(const pc_device_diagram* diagram, pc_domain** domain);
POWERCELL_API pc_status pc_device_diagram_device(const pc_device_diagram* diagram, pc_device** device);

/** For domains of several convex regions: the room for candidate pairs of a seed and a region. Seeds whose
 * pairs exceed it are unfinished. With 0, the default, there is room for all, and pc_device_diagram_enqueue()
 * waits for the queue once to read their number. It waits only for that, and as
 * pc_device_diagram_set_image_capacity() says. */
POWERCELL_API pc_status pc_device_diagram_set_pair_capacity(pc_device_diagram* diagram, uint32_t pairs);

/** The room for walls and boundary walls while rows are made of them; at most 2^31. Cells whose walls do not
 * fit are unfinished; which these are may change from call to call. With 0, the default, there is room for
 * more walls than random seeds have (powercell::DeviceDiagram). */
POWERCELL_API pc_status pc_device_diagram_set_wall_capacity(pc_device_diagram* diagram, uint32_t walls);

/** For periodic domains: the room for images of seeds behind the borders. If there are more, all cells are
 * unfinished but those that are hidden without them; how many there are for random seeds is said at
 * powercell::DeviceDiagram. With 0, the default, there is room for all, and pc_device_diagram_enqueue() waits
 * for the queue once to read their number. */
POWERCELL_API pc_status pc_device_diagram_set_image_capacity(pc_device_diagram* diagram, uint32_t images);

/** A density for measures, which are then its integrals over the cells: linear in each triangle or
 * tetrahedron of the domain. Statuses, walls and geometry stay those of the cells alone. A cell with a part
 * in a region at a corner of which the value is no density has NaN for all its measures
 * (powercell::DeviceDiagram:: set_density). The first call with a buffer builds kernels; this waits. \param
 * values  read by each diagram enqueued later: a real for each vertex of the mesh, in the order of
 *   pc_domain_surface() or pc_domain_volume(), a buffer that is retained until another one is set; NULL: no
 *   density
 * \return PC_UNSUPPORTED unless the domain is such a mesh */
POWERCELL_API pc_status pc_device_diagram_set_density(pc_device_diagram* diagram, cl_mem values);

/** Enqueues one diagram of n seeds in d coordinates and flushes the queue. Buffers are of the context
 * of the device and must not change between the wait list and `done`.
 * \param positions  read: n x d reals, row-major
 * \param weights    read: n reals; NULL means all zero
 * \param n          at most 2^30; with 0 the buffers may be NULL
 * \param measures   written: n x (2 + d) reals, row-major: mass, centroid, second moment about the
 *   seed. 0, NaN..., 0 for hidden and duplicate seeds; all NaN for invalid and unfinished ones
 * \param status     written: n cl_uint, each a pc_device_seed_status
 * \param wait_count  how many events must be complete before the first command runs
 * \param wait_list  these events
 * \param done       if not NULL: the event of the last command, for the caller to release */
POWERCELL_API pc_status pc_device_diagram_enqueue(pc_device_diagram* diagram, cl_mem positions,
                                                  cl_mem weights, uint32_t n, cl_mem measures, cl_mem status,
                                                  cl_uint wait_count, const cl_event* wait_list,
                                                  cl_event* done);

/** The pairs of cells that share a wall, as compressed sparse rows in the caller's buffers. Which walls that
 * rounding may have decided are kept is said at powercell::DeviceAdjacency. */
typedef struct pc_device_adjacency {
  cl_mem offset;   /**< written: n + 1 cl_uint; right also where the next two are too small */
  cl_mem neighbor; /**< written: cl_uint each, ascending within a row */
  cl_mem wall;  /**< written: a real each, the length or area. Rows that end beyond the entries that fit all
                     buffers are not written, the others are whole */
  cl_mem shift; /**< in a periodic domain, else NULL; written: 3 cl_int an entry, the image of the neighbour,
                   as in pc_adjacency */
} pc_device_adjacency;

/** The seeds whose cells only the host can decide: those that are unfinished, and those of whose cells
 * rounding may have decided the shape (powercell::DeviceUncertain). */
typedef struct pc_device_uncertain {
  cl_mem count; /**< written: one cl_uint, how many they are, also where they do not fit */
  cl_mem seeds; /**< written: cl_uint each, their indices, ascending; as many as fit the buffer */
} pc_device_uncertain;

/** The geometry of the cells as convex pieces, as pc_cells has it; only seeds whose status is ok have pieces
 * (powercell::DeviceCells). If some buffers are too small, then the first cells are written, as many as fit
 * all of them, and nothing of the others. */
typedef struct pc_device_cells {
  cl_mem counts; /**< written: 4 cl_ulong, how many pieces, vertices, faces and entries of `loop` all cells
                    have, also where they do not fit */
  cl_mem cell_offset;   /**< written: n + 1 cl_ulong, always right; cell i owns the pieces
                             [cell_offset[i], cell_offset[i+1]) */
  cl_mem region;        /**< written: a cl_uint a piece, the region of the domain it lies in */
  cl_mem vertex_offset; /**< written: cl_ulong, one more than pieces */
  cl_mem vertices;      /**< written: d reals a vertex, row-major; in a periodic domain near the seed */
  cl_mem face_offset;   /**< written: cl_ulong, one more than pieces */
  cl_mem border; /**< written: 2 cl_uint a face, the pc_border_kind and the index, as pc_border has them */
  cl_mem shift;  /**< in a periodic domain, else NULL; written: 3 cl_int a face, as in pc_cells */
  cl_mem loop_offset; /**< of cells of dimension 3, else NULL; written: cl_ulong, one more than faces */
  cl_mem loop;        /**< likewise; written: cl_uint, indices from 0 within the vertices of the piece */
} pc_device_cells;

/** The parts of the domain's boundary that belong to each cell, as compressed sparse rows in the caller's
 * buffers; the numbers of facets are those of pc_boundary_walls (powercell::DeviceBoundaryWalls). */
typedef struct pc_device_boundary_walls {
  cl_mem offset;  /**< written: n + 1 cl_uint; right also where the next two are too small */
  cl_mem facet;   /**< written: cl_uint each, ascending within a row */
  cl_mem measure; /**< written: a real each, the length or area. Rows that end beyond the entries that fit
                     both buffers are not written, the others are whole */
} pc_device_boundary_walls;

/** What a diagram writes, in buffers of the caller. */
typedef struct pc_device_results {
  cl_mem measures;                         /**< as in pc_device_diagram_enqueue() */
  cl_mem status;                           /**< the same */
  pc_device_adjacency adjacency;           /**< where it is wanted, in the same pass; else NULL each */
  pc_device_uncertain uncertain;           /**< where it is wanted; else NULL each */
  pc_device_cells cells;                   /**< where it is wanted, in two more passes; else NULL each */
  pc_device_boundary_walls boundary_walls; /**< where it is wanted, in the same pass; else NULL each */
} pc_device_results;

/** As pc_device_diagram_enqueue(), with all that is wanted. */
POWERCELL_API pc_status pc_device_diagram_enqueue_results(pc_device_diagram* diagram, cl_mem positions,
                                                          cl_mem weights, uint32_t n,
                                                          const pc_device_results* results,
                                                          cl_uint wait_count, const cl_event* wait_list,
                                                          cl_event* done);

/** Computes the cells of the list results->uncertain exactly, on the host where needed, and puts them into
 * the results, which are then those of a pc_diagram with exact decisions (powercell::DeviceDiagram::repair).
 * Waits for the queue.
 * \param positions  as given to pc_device_diagram_enqueue_results() before
 * \param weights    as given there
 * \param n          as given there
 * \param results  as written by that call, with the list
 * \param computed  if not NULL: how many cells were computed
 * \return PC_INVALID_ARGUMENT where the list was too small for all uncertain seeds, or the rows are for all
 *   entries, or the buffers of cells for all cells: pc_last_error() says how much room is needed; the results
 * are unchanged */
POWERCELL_API pc_status pc_device_diagram_repair(pc_device_diagram* diagram, cl_mem positions, cl_mem weights,
                                                 uint32_t n, const pc_device_results* results,
                                                 uint32_t* computed);

#ifdef __cplusplus
}
#endif
#endif
