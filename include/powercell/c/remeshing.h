/** \file
 * Repair of triangle meshes, and new meshes of surfaces with well-shaped triangles.
 */
#ifndef POWERCELL_C_REMESHING_H
#define POWERCELL_C_REMESHING_H

#include <powercell/c/device.h>

#ifdef __cplusplus
extern "C" {
#endif

/** How often something was done or found, and a place of the first time. This struct does not grow. */
typedef struct pc_repair_count {
  size_t count;
  double first[3];
} pc_repair_count;

/** What was done to a mesh, in this order, and what was left. */
typedef struct pc_repair_report {
  pc_repair_count degenerate;     /**< triangles with two corners at one position, removed */
  pc_repair_count repeated;       /**< triangles with the corners of an earlier one, removed */
  pc_repair_count split_edges;    /**< edges of more than two triangles, split into edges of two or one */
  pc_repair_count split_vertices; /**< vertices where sheets touch, split into one for each sheet */
  pc_repair_count welded;         /**< pairs of boundary edges that are a little apart, joined */
  double moved;                   /**< the farthest that welding moved a vertex */
  pc_repair_count turned;         /**< triangles turned, as their part is oriented otherwise */
  pc_repair_count flat;           /**< triangles without area, removed by flips and collapses of edges */
  pc_repair_count left_flat;      /**< triangles without area that could not be removed */
  pc_repair_count intersections;  /**< pairs of triangles that cross each other */
  size_t components;
  size_t boundary_edges;
  int changed; /**< 1 if anything was done, else 0 */
  size_t act_count;
  const char* const* acts; /**< what was done, a sentence for each kind */
  size_t left_count;
  const char* const* left; /**< what was left */
} pc_repair_report;

/** A mesh after repair. */
typedef struct pc_repaired_mesh {
  size_t vertex_count, triangle_count;
  const double* vertices;    /**< vertex_count x 3; vertices keep their order, split ones are at the end */
  const uint32_t* triangles; /**< triangle_count x 3 */
  const pc_repair_report* report;
} pc_repaired_mesh;

/** Makes a mesh an oriented manifold with boundary, as far as nothing of its shape is lost.
 * \param vertices   vertex_count x 3, row-major
 * \param triangles  triangle_count x 3, indices from 0
 * \param weld       edges of the boundary whose ends are up to this far apart are joined; 0: edges
 *   at the same position only; below 0, as a rule: 10^-6 of the diagonal, or the rounding of
 *   coordinates if that is more */
POWERCELL_API pc_status pc_repair(const double* vertices, size_t vertex_count, const uint32_t* triangles,
                                  size_t triangle_count, double weld, const pc_repaired_mesh** mesh);
POWERCELL_API void pc_repaired_mesh_destroy(const pc_repaired_mesh* mesh);

typedef enum pc_remesh_method {
  PC_REMESH_FARTHEST_POINT = 0, /**< removes each point in turn and reinserts it far from the others */
  PC_REMESH_TRANSPORT           /**< moves the points to the centroids of cells of equal mass */
} pc_remesh_method;

/** Options of pc_remesh(). Fill with pc_remesh_options_init() first. */
typedef struct pc_remesh_options {
  size_t struct_size; /**< set by pc_remesh_options_init() */
  pc_remesh_method method;
  int repair;         /**< not 0, the default: by pc_repair(); else edges are joined by indices alone */
  size_t count;       /**< number of vertices of the new mesh, met exactly; at least 4; default 5000 */
  double gradation;   /**< limit on the gradient of the edge length over the surface; (0, 10]; default 0.2 */
  double contrast;    /**< limit on the ratio of two target edge lengths, 1 to 1000; default 4 */
  double sharp_angle; /**< degrees, (0, 180]; edges with a larger angle are kept; default 45 */
  int rounds;         /**< limit on rounds of the method; default 20 */
  int relaxations;    /**< rounds of the final relaxation; default 15 */
  uint64_t random_seed;    /**< default 1 */
  const pc_device* device; /**< for the method transport; NULL for the default one */
  pc_progress progress;    /**< may be NULL */
  void* progress_user;     /**< passed to progress */
} pc_remesh_options;

/** Sets every option to its default. \param struct_size  sizeof(pc_remesh_options) */
POWERCELL_API pc_status pc_remesh_options_init(pc_remesh_options* options, size_t struct_size);

/** A new mesh. */
typedef struct pc_remesh_result {
  size_t vertex_count, triangle_count;
  const double* vertices;         /**< vertex_count x 3, row-major, on the old surface */
  const uint32_t* triangles;      /**< triangle_count x 3, indices from 0 */
  const pc_repair_report* repair; /**< what was done to the input and what was left */
  const uint8_t* fixed;           /**< vertex_count: 1 on a boundary, a sharp edge or a corner, else 0 */
  const double* sizing;           /**< vertex_count: the target edge length h */
  size_t round_count;
  const double*
      least_spacing;   /**< round_count: least distance between neighbours, over h, after each round */
  size_t added;        /**< points beyond `count` that the dual needed; later collapsed */
  int collapsed;       /**< 1 if made by collapsing edges of the input, as the points are too few; else 0 */
  int has_inseparable; /**< 1 if `inseparable` is a place that is the reason for it */
  double inseparable[3];
  pc_repair_count intersections; /**< pairs of triangles of the new mesh that cross each other */
  double seconds_sample, seconds_dual, seconds_relax; /**< wall-clock times of the stages */
} pc_remesh_result;

/** Remeshes a surface. The new mesh is a manifold with the same Euler characteristic and number of
 * boundary loops; it reproduces the boundaries, the edges sharper than `sharp_angle` and their corners.
 * \param vertices   vertex_count x 3, row-major
 * \param triangles  triangle_count x 3, indices from 0
 * \param options    NULL for the defaults */
POWERCELL_API pc_status pc_remesh(const double* vertices, size_t vertex_count, const uint32_t* triangles,
                                  size_t triangle_count, const pc_remesh_options* options,
                                  const pc_remesh_result** result);
POWERCELL_API void pc_remesh_result_destroy(const pc_remesh_result* result);

/** Quality of a triangle mesh. */
typedef struct pc_mesh_quality {
  size_t vertices, triangles;  /**< vertices that triangles use */
  double q_min, q_mean;        /**< of 6/sqrt(3) area / (half perimeter x longest edge), 1 if equilateral */
  double angle_min, angle_max; /**< degrees */
  double angle_min_mean;       /**< mean over the triangles of the smallest angle, degrees */
  double below_30;             /**< share of angles below 30 degrees */
  double regular;              /**< share of vertices with degree 5 to 7, or 3 to 5 on the boundary */
  int euler_characteristic;
  int boundary_loops;
  int manifold; /**< 1 if consistently oriented and a manifold, else 0 */
} pc_mesh_quality;

/** Measures the quality of a triangle mesh. */
POWERCELL_API pc_status pc_mesh_quality_create(const double* vertices, size_t vertex_count,
                                               const uint32_t* triangles, size_t triangle_count,
                                               const pc_mesh_quality** quality);
POWERCELL_API void pc_mesh_quality_destroy(const pc_mesh_quality* quality);

/** The largest distance from surface b of the vertices of surface a and about `samples` points spread over it
 * (0 means 200000): a lower bound of the one-sided Hausdorff distance. Arrays as for pc_remesh(). */
POWERCELL_API pc_status pc_farthest_from(const double* vertices_a, size_t vertex_count_a,
                                         const uint32_t* triangles_a, size_t triangle_count_a,
                                         const double* vertices_b, size_t vertex_count_b,
                                         const uint32_t* triangles_b, size_t triangle_count_b, size_t samples,
                                         double* distance);

#ifdef __cplusplus
}
#endif
#endif
