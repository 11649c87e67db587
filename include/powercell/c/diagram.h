/** \file
 * Power diagrams restricted to a domain.
 */
#ifndef POWERCELL_C_DIAGRAM_H
#define POWERCELL_C_DIAGRAM_H

#include <powercell/c/device.h>
#include <powercell/c/domain.h>
#include <powercell/c/options.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pc_diagram pc_diagram; /**< a power diagram of seeds in a domain, on a device */

/** State of a seed in pc_diagram_measures(). */
typedef enum pc_seed_status { PC_SEED_OK = 0, PC_SEED_HIDDEN, PC_SEED_DUPLICATE } pc_seed_status;

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
