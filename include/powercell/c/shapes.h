/** \file
 * Simple shapes as plain arrays, for examples and tests.
 */
#ifndef POWERCELL_C_SHAPES_H
#define POWERCELL_C_SHAPES_H

#include <powercell/c/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A triangle mesh, as pc_domain_surface() takes it. */
typedef struct pc_triangle_mesh {
  size_t vertex_count, triangle_count;
  const double* vertices;    /**< vertex_count x 3, row-major */
  const uint32_t* triangles; /**< triangle_count x 3, indices from 0, counter-clockwise seen from outside */
} pc_triangle_mesh;

/** A tetrahedral mesh, as pc_domain_volume() takes it. */
typedef struct pc_tetrahedral_mesh {
  size_t vertex_count, tetrahedron_count;
  const double* vertices;     /**< vertex_count x 3, row-major */
  const uint32_t* tetrahedra; /**< tetrahedron_count x 4, indices from 0, positively oriented */
} pc_tetrahedral_mesh;

/** A regular polygon inscribed in the unit circle about the origin, counter-clockwise from (1, 0).
 * \param segments  number of corners, at least 3
 * \param points    segments x 2, row-major */
POWERCELL_API pc_status pc_shape_disk(int segments, double* points);
/** The unit sphere about the origin, of 20 resolution^2 triangles. \param resolution  1 to 4096 */
POWERCELL_API pc_status pc_shape_sphere(int resolution, const pc_triangle_mesh** mesh);
/** The torus about the z axis with radii 1 and 0.4. \param resolution  around the tube, 3 to 16384 */
POWERCELL_API pc_status pc_shape_torus(int resolution, const pc_triangle_mesh** mesh);
/** The unit ball about the origin, of 8 resolution^3 tetrahedra. \param resolution  1 to 256 */
POWERCELL_API pc_status pc_shape_ball(int resolution, const pc_tetrahedral_mesh** mesh);
POWERCELL_API void pc_triangle_mesh_destroy(const pc_triangle_mesh* mesh);
POWERCELL_API void pc_tetrahedral_mesh_destroy(const pc_tetrahedral_mesh* mesh);

#ifdef __cplusplus
}
#endif
#endif
