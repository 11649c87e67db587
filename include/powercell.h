/** \file
 * powercell for C: power diagrams of weighted points in a polygon, on a surface or in a volume.
 *
 * The power distance of x to seed i is |x - p_i|^2 - w_i, so a weight has the unit length^2 (for a disc
 * or ball of radius r around p_i, w_i = r^2), may have any sign, and a constant added to all weights
 * changes nothing.
 *
 * Every function returns a pc_status and hands its result back through its last arguments. On failure
 * pc_last_error() says in words what went wrong, in the calling thread. Handles are opaque and freed by
 * the matching _destroy function, which accepts NULL. Arrays of the caller are copied, never kept.
 *
 * Arrays of a size not known beforehand are asked for twice: first with a NULL array, which sets only
 * *count; then with an array of at least that many entries. An array that is too short is left alone and
 * gives PC_INVALID_ARGUMENT.
 *
 * A handle may be used by one thread at a time; different handles by different threads.
 */
#ifndef POWERCELL_H
#define POWERCELL_H

#include <stddef.h>
#include <stdint.h>

#include <powercell/export.hpp> /* only macros: legal in C */

#ifdef __cplusplus
extern "C" {
#endif

/** What went wrong; the same codes, in the same order, as powercell::ErrorCode. */
typedef enum pc_status {
  PC_OK = 0,
  PC_INVALID_ARGUMENT,     /**< sizes that do not match, an option out of range, a NULL handle */
  PC_INVALID_SEED,         /**< NaN or infinity in a position or weight */
  PC_INVALID_DOMAIN,       /**< self-intersection, index out of range, empty domain */
  PC_INVALID_FILE,         /**< unreadable or malformed file */
  PC_WRITE_FAILED,         /**< a file could not be written whole */
  PC_DEVICE_NOT_FOUND,     /**< no device matches the selector */
  PC_NO_FP64,              /**< double precision asked of a device that has none */
  PC_BUILD_FAILED,         /**< a kernel did not compile */
  PC_SELF_TEST_FAILED,     /**< the device computed a known diagram wrongly */
  PC_OUT_OF_DEVICE_MEMORY, /**< allocation failed even in the smallest chunks */
  PC_OPENCL,               /**< any other OpenCL error */
  PC_UNSUPPORTED,          /**< asked for what this build or device does not have */
  PC_INTERRUPTED,          /**< the progress callback asked to stop */
  PC_NOT_CONVERGED,        /**< an iteration ended above its tolerance */
  PC_INTERNAL,             /**< a law of the library was broken: please report */
  PC_OUT_OF_MEMORY         /**< host memory; has no ErrorCode of its own */
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

/** What becomes of cells whose shape rounding may have decided (powercell::Decisions). */
typedef enum pc_decisions { PC_DECISIONS_EXACT = 0, PC_DECISIONS_FAST } pc_decisions;

/** How much of the log is wanted (powercell::LogLevel). */
typedef enum pc_log_level { PC_LOG_INFO = 0, PC_LOG_DETAIL } pc_log_level;

/** Gets one line of the log, ended by a zero byte. Must not throw or call pc_set_log(). */
typedef void (*pc_log_sink)(pc_log_level level, const char* line, void* user);

/** Options of a diagram. Fill with pc_options_init() first. */
typedef struct pc_options {
  pc_precision precision;
  pc_neighbors neighbors;
  pc_decisions decisions;
  int certify;           /**< not 0: check each result by laws, PC_INTERNAL if one does not hold */
  int initial_neighbors; /**< FLANN only: 0 means 16, or 32 in volumes */
  int threads;           /**< host threads; 0 means all */
  uint64_t chunk_pairs;  /**< most (region, seed) pairs on the device at once; 0 means by its memory */
  pc_progress progress;  /**< may be NULL */
  void* progress_user;   /**< handed to progress */
} pc_options;

/** The library's version, "major.minor.patch"; static storage. */
POWERCELL_API const char* pc_version(void);
/** Stable lower-case name of a status, e.g. "invalid_seed"; static storage. */
POWERCELL_API const char* pc_status_name(pc_status status);
/** What the last failed call of this thread said; "" before the first. Valid until the next failure. */
POWERCELL_API const char* pc_last_error(void);

/** From now on `sink` gets the lines of the log up to level `most`, from any thread but one at a time; NULL
 * ends that. While there is none, the environment variable POWERCELL_LOG (info or detail) sends them to
 * standard error. */
POWERCELL_API pc_status pc_set_log(pc_log_sink sink, pc_log_level most, void* user);

/** The device that `selector` names ("P:D", part of a name, "cpu", "gpu"); NULL or "" for the default. */
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
/** A triangle mesh in space. vertices: vertex_count x 3; triangles: triangle_count x 3, from 0. */
POWERCELL_API pc_status pc_domain_surface(const double* vertices, size_t vertex_count,
                                          const uint32_t* triangles, size_t triangle_count,
                                          pc_domain** domain);
/** A tetrahedral mesh. vertices: vertex_count x 3; tetrahedra: tetrahedron_count x 4, from 0. */
POWERCELL_API pc_status pc_domain_volume(const double* vertices, size_t vertex_count,
                                         const uint32_t* tetrahedra, size_t tetrahedron_count,
                                         pc_domain** domain);
/** An axis-aligned box; low and high: `dimension` (2 or 3) doubles each. */
POWERCELL_API pc_status pc_domain_box(const double* low, const double* high, int dimension,
                                      pc_domain** domain);
POWERCELL_API void pc_domain_destroy(pc_domain* domain);
/** Area or volume. */
POWERCELL_API pc_status pc_domain_measure(const pc_domain* domain, double* measure);

/** Sets every option to its default. */
POWERCELL_API void pc_options_init(pc_options* options);

/** A diagram without seeds yet. It keeps what it needs of device and domain: these may be destroyed
 * before it. \param options NULL for the defaults */
POWERCELL_API pc_status pc_diagram_create(const pc_device* device, const pc_domain* domain,
                                          const pc_options* options, pc_diagram** diagram);
POWERCELL_API void pc_diagram_destroy(pc_diagram* diagram);

/** \param positions count x d, row-major, unit length (d: 2 in polygons, 3 on surfaces and in volumes)
 * \param weights   count, unit length^2; NULL means all zero */
POWERCELL_API pc_status pc_diagram_set_seeds(pc_diagram* diagram, const double* positions,
                                             const double* weights, size_t count);
/** New weights for the same positions; redoes only what depends on weights. */
POWERCELL_API pc_status pc_diagram_set_weights(pc_diagram* diagram, const double* weights, size_t count);

/** Number of seeds set. */
POWERCELL_API pc_status pc_diagram_size(const pc_diagram* diagram, size_t* count);

/** Measures of the cells, in the order of the seeds; computes what is not known yet. Each array may be
 * NULL where it is not wanted. n seeds, d coordinates.
 * \param mass           n: area or volume; 0 where empty
 * \param centroid       n x d, row-major; NaN where empty
 * \param second_moment  n: integral of |x - p_i|^2 over the cell
 * \param status         n: a pc_seed_status each */
POWERCELL_API pc_status pc_diagram_measures(pc_diagram* diagram, double* mass, double* centroid,
                                            double* second_moment, uint8_t* status);

/** Which cells share a wall, as compressed sparse rows (asked for twice, see above).
 * \param offset    n + 1 entries, or NULL to learn *count only
 * \param neighbor  *count entries, ascending within a row; NULL to learn *count and offset only
 * \param wall      *count entries: length or area of the wall; may be NULL
 * \param count     in: room in neighbor and wall (when neighbor is not NULL); out: entries there are */
POWERCELL_API pc_status pc_diagram_adjacency(pc_diagram* diagram, uint64_t* offset, uint32_t* neighbor,
                                             double* wall, size_t* count);

/** The regular triangulation restricted to the domain (asked for twice, see above).
 * \param corners    corners of a simplex: 3 or 4
 * \param simplices  *count rows of `corners` seed indices, or NULL
 * \param count      in: rows there is room for (when simplices is not NULL); out: rows there are */
POWERCELL_API pc_status pc_diagram_dual(pc_diagram* diagram, int* corners, uint32_t* simplices,
                                        size_t* count);

#ifdef __cplusplus
}
#endif
#endif
