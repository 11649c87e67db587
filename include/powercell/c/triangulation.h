/** \file
 * Regular triangulations (weighted Delaunay): the dual of the power diagram of the whole space.
 */
#ifndef POWERCELL_C_TRIANGULATION_H
#define POWERCELL_C_TRIANGULATION_H

#include <powercell/c/device.h>
#include <powercell/c/options.h>
#include <powercell/c/results.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A triangulation of the caller's. */
typedef struct pc_triangulation {
  pc_dual dual;
} pc_triangulation;

/** The regular triangulation of seeds in the plane (triangles) or in space (tetrahedra). It
 * triangulates the convex hull of any seeds without flat simplices. Seeds that are not vertices of it
 * are hidden or duplicates. Empty if the seeds do not span the space.
 * \param dimension  2 or 3
 * \param positions  count x dimension, row-major; not below 1e-100 or above 1e100
 * \param weights    count; NULL means all zero
 * \param options    NULL for the defaults; `decisions` is ignored */
POWERCELL_API pc_status pc_triangulation_create(const pc_device* device, int dimension,
                                                const double* positions, const double* weights, size_t count,
                                                const pc_options* options,
                                                const pc_triangulation** triangulation);
POWERCELL_API void pc_triangulation_destroy(const pc_triangulation* triangulation);

#ifdef __cplusplus
}
#endif
#endif
