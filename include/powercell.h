/** \file
 * powercell for C: power diagrams of weighted points in a polygon, on a surface or in a volume.
 *
 * The power distance of x to seed i is |x - p_i|^2 - w_i, so a weight has the unit length^2 (for a disc
 * or ball of radius r around p_i, w_i = r^2), may have any sign, and a constant added to all weights
 * changes nothing.
 *
 * Functions return a pc_status and write their results through their last arguments. After a failure
 * pc_last_error() describes it, in the calling thread. Handles are opaque and freed by the matching _destroy
 * function, which accepts NULL. Arrays of the caller are copied.
 *
 * An array whose size is not known beforehand takes two calls: the first with NULL for the array sets only
 * *count; the second takes an array of at least that many entries. If the array is too short nothing is
 * written and the call fails with PC_INVALID_ARGUMENT.
 *
 * Use a handle in one thread at a time; different threads may use different handles.
 */
#ifndef POWERCELL_H
#define POWERCELL_H

#include <stddef.h>
#include <stdint.h>

#include <powercell/export.hpp> /* only macros: legal in C */

#ifdef __cplusplus
extern "C" {
#endif

/** Kinds of failures, in the order of powercell::ErrorCode. */
typedef enum pc_status {
  PC_OK = 0,
  PC_INVALID_ARGUMENT,     /**< sizes that do not match, an option out of range, a NULL handle */
  PC_INVALID_SEED,         /**< NaN or infinity in a position or weight */
  PC_INVALID_DOMAIN,       /**< self-intersection, index out of range, empty domain */
  PC_INVALID_FILE,         /**< unreadable or malformed file */
  PC_WRITE_FAILED,         /**< a file could not be written whole */
  PC_DEVICE_NOT_FOUND,     /**< no device matches the selector */
  PC_NO_FP64,              /**< double precision requested on a device without it */
  PC_BUILD_FAILED,         /**< a kernel did not compile */
  PC_SELF_TEST_FAILED,     /**< the device computed a known diagram incorrectly */
  PC_OUT_OF_DEVICE_MEMORY, /**< an allocation failed, even in the smallest chunks */
  PC_OPENCL,               /**< any other OpenCL error */
  PC_UNSUPPORTED,          /**< this build or device does not have the feature */
  PC_INTERRUPTED,          /**< the progress callback asked to stop */
  PC_NOT_CONVERGED,        /**< an iteration ended above its tolerance */
  PC_INTERNAL,             /**< an invariant of the library does not hold: please report */
  PC_OUT_OF_MEMORY         /**< host memory; std::bad_alloc in C++ */
} pc_status;

typedef enum pc_precision { PC_PRECISION_AUTOMATIC = 0, PC_FLOAT64, PC_FLOAT32 } pc_precision;
typedef enum pc_neighbors { PC_NEIGHBORS_AUTOMATIC = 0, PC_TREE, PC_FLANN } pc_neighbors;

/** State of a seed in pc_diagram_status(). */
typedef enum pc_seed_status { PC_SEED_OK = 0, PC_SEED_HIDDEN, PC_SEED_DUPLICATE } pc_seed_status;

typedef struct pc_device pc_device;   /**< an OpenCL device with its context, queue and programs */
typedef struct pc_domain pc_domain;   /**< an immutable, validated domain */
typedef struct pc_diagram pc_diagram; /**< a power diagram of seeds in a domain, on a device */

/** Returns 0 to stop the computation with PC_INTERRUPTED. Must not throw. */
typedef int (*pc_progress)(double fraction, void* user);

/** How to treat cells whose shape rounding may have decided (powercell::Decisions). */
typedef enum pc_decisions { PC_DECISIONS_EXACT = 0, PC_DECISIONS_FAST } pc_decisions;

/** The detail of the log (powercell::LogLevel). */
typedef enum pc_log_level { PC_LOG_INFO = 0, PC_LOG_DETAIL } pc_log_level;

/** Receives one line of the log, ended by a zero byte. Must not throw or call pc_set_log(). */
typedef void (*pc_log_sink)(pc_log_level level, const char* line, void* user);

/** Options of a diagram. Fill with pc_options_init() first. */
typedef struct pc_options {
  pc_precision precision;
  pc_neighbors neighbors;
  pc_decisions decisions;
  int certify;           /**< not 0: check each result by laws; PC_INTERNAL if one does not hold */
  int initial_neighbors; /**< FLANN only: 0 means 16, or 32 in volumes */
  int threads;           /**< host threads; 0 means all */
  uint64_t chunk_pairs; /**< the most (region, seed) pairs on the device at once; 0 lets the library choose */
  pc_progress progress; /**< may be NULL */
  void* progress_user;  /**< passed to progress */
} pc_options;

/** The library's version, "major.minor.patch"; static storage. */
POWERCELL_API const char* pc_version(void);
/** Stable lower-case name of a status, e.g. "invalid_seed"; static storage. */
POWERCELL_API const char* pc_status_name(pc_status status);
/** The message of the last failure in this thread; "" before the first. Valid until the next failure. */
POWERCELL_API const char* pc_last_error(void);

/** Sends the lines of the log up to level `most` to `sink`, from any thread, one call at a time; NULL removes
 * the sink. Without a sink the environment variable POWERCELL_LOG (info or detail) sends them to standard
 * error. */
POWERCELL_API pc_status pc_set_log(pc_log_sink sink, pc_log_level most, void* user);

/** Opens the device that `selector` names ("P:D", part of a name, "cpu", "gpu"); NULL or "" for the default.
 */
POWERCELL_API pc_status pc_device_create(const char* selector, pc_device** device);
POWERCELL_API void pc_device_destroy(pc_device* device);
/** The device's name; owned by the handle. NULL for a NULL handle. */
POWERCELL_API const char* pc_device_name(const pc_device* device);

/** A polygon of one or more parts, each an outer ring and its holes, in either orientation.
 * \param points       all rings one after the other, 2 doubles a point, unit length
 * \param ring_offset  rings + 1 entries: ring r has the points [ring_offset[r], ring_offset[r+1])
 * \param part_offset  parts + 1 entries: part p has the rings [part_offset[p], part_offset[p+1]), its
 *                     outer one first. The parts must not overlap. */
POWERCELL_API pc_status pc_domain_polygon(const double* points, const size_t* ring_offset,
                                          const size_t* part_offset, size_t parts, pc_domain** domain);
/** A triangle mesh in space. vertices: vertex_count x 3; triangles: triangle_count x 3, from 0. Flat
 * triangles and those with the corners of an earlier one are left out; overlaps in a plane count twice. */
POWERCELL_API pc_status pc_domain_surface(const double* vertices, size_t vertex_count,
                                          const uint32_t* triangles, size_t triangle_count,
                                          pc_domain** domain);
/** A tetrahedral mesh. vertices: vertex_count x 3; tetrahedra: tetrahedron_count x 4, from 0. Flat
 * tetrahedra and those with the corners of an earlier one are left out; overlaps of more than 10^-6 of the
 * volume are an error. */
POWERCELL_API pc_status pc_domain_volume(const double* vertices, size_t vertex_count,
                                         const uint32_t* tetrahedra, size_t tetrahedron_count,
                                         pc_domain** domain);
/** The inside of a closed triangle mesh, without tetrahedra: measures and adjacency. Shells in shells bound
 * cavities and bodies in turn. Open, self-crossing and partly turned surfaces are an error. */
POWERCELL_API pc_status pc_domain_solid(const double* vertices, size_t vertex_count,
                                        const uint32_t* triangles, size_t triangle_count, pc_domain** domain);
/** An axis-aligned box; low and high: `dimension` (2 or 3) doubles each. */
POWERCELL_API pc_status pc_domain_box(const double* low, const double* high, int dimension,
                                      pc_domain** domain);
POWERCELL_API void pc_domain_destroy(pc_domain* domain);
/** Area or volume. */
POWERCELL_API pc_status pc_domain_measure(const pc_domain* domain, double* measure);

/** Sets every option to its default. */
POWERCELL_API void pc_options_init(pc_options* options);

/** A diagram without seeds. Device and domain may be destroyed before it. \param options NULL for the
 * defaults */
POWERCELL_API pc_status pc_diagram_create(const pc_device* device, const pc_domain* domain,
                                          const pc_options* options, pc_diagram** diagram);
POWERCELL_API void pc_diagram_destroy(pc_diagram* diagram);

/** \param positions count x d, row-major, unit length (d: 2 in polygons, 3 on surfaces and in volumes)
 * \param weights   count, unit length^2; NULL means all zero */
POWERCELL_API pc_status pc_diagram_set_seeds(pc_diagram* diagram, const double* positions,
                                             const double* weights, size_t count);
/** Sets new weights for the same positions; only the work that depends on weights is repeated. */
POWERCELL_API pc_status pc_diagram_set_weights(pc_diagram* diagram, const double* weights, size_t count);

/** The number of seeds. */
POWERCELL_API pc_status pc_diagram_size(const pc_diagram* diagram, size_t* count);

/** The measures of the cells, in the order of the seeds; computed if they are not known yet. Any array may be
 * NULL. n seeds, d coordinates. \param mass           n: area or volume; 0 where empty \param centroid n x d,
 * row-major; NaN where empty \param second_moment  n: integral of |x - p_i|^2 over the cell \param status n:
 * a pc_seed_status each */
POWERCELL_API pc_status pc_diagram_measures(pc_diagram* diagram, double* mass, double* centroid,
                                            double* second_moment, uint8_t* status);

/** The pairs of cells that share a wall, as compressed sparse rows (two calls, see above).
 * \param offset    n + 1 entries, or NULL for *count alone
 * \param neighbor  *count entries, ascending within a row; NULL for *count and offset alone
 * \param wall      *count entries: length or area of the wall; may be NULL
 * \param count     in: room in neighbor and wall (when neighbor is not NULL); out: number of entries */
POWERCELL_API pc_status pc_diagram_adjacency(pc_diagram* diagram, uint64_t* offset, uint32_t* neighbor,
                                             double* wall, size_t* count);

/** The regular triangulation restricted to the domain (two calls, see above).
 * \param corners    corners of a simplex: 3 or 4
 * \param simplices  *count rows of `corners` seed indices, or NULL
 * \param count      in: room for rows (when simplices is not NULL); out: number of rows */
POWERCELL_API pc_status pc_diagram_dual(pc_diagram* diagram, int* corners, uint32_t* simplices,
                                        size_t* count);

#ifdef __cplusplus
}
#endif
#endif
