/** \file
 * Domains: the polygon, surface or volume that a diagram is restricted to.
 */
#ifndef POWERCELL_C_DOMAIN_H
#define POWERCELL_C_DOMAIN_H

#include <powercell/c/base.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pc_domain pc_domain; /**< an immutable, validated domain */

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

#ifdef __cplusplus
}
#endif
#endif
