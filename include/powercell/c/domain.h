/** \file
 * Domains: the polygon, surface or volume that a diagram is restricted to.
 */
#ifndef POWERCELL_C_DOMAIN_H
#define POWERCELL_C_DOMAIN_H

#include <powercell/c/results.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pc_domain pc_domain; /**< an immutable, validated domain */

typedef enum pc_domain_kind { PC_POLYGON = 0, PC_SURFACE, PC_VOLUME } pc_domain_kind;

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
/** A box whose opposite sides are identified along the axes where `periodic` is not 0; at least one.
 * \param low       the lower corner, `dimension` (2 or 3) doubles
 * \param high      the upper corner, as many
 * \param periodic  `dimension` numbers; NULL means all axes */
POWERCELL_API pc_status pc_domain_periodic_box(const double* low, const double* high, const int* periodic,
                                               int dimension, pc_domain** domain);
/** The plane or space modulo a lattice.
 * \param vectors  `dimension` (2 or 3) rows of as many doubles, in any basis and orientation
 * \param origin   a corner of the parallelogram or parallelepiped of the domain; NULL means 0 */
POWERCELL_API pc_status pc_domain_lattice(const double* vectors, const double* origin, int dimension,
                                          pc_domain** domain);
POWERCELL_API void pc_domain_destroy(pc_domain* domain);

/** What a domain is. */
typedef struct pc_domain_info {
  pc_domain_kind kind;
  int dimension;      /**< of the space: 2 or 3 */
  int cell_dimension; /**< of the cells: 2 in polygons and on surfaces, 3 in volumes */
  int is_periodic;    /**< not 0: along some axis */
  int is_solid;       /**< not 0: made by pc_domain_solid() */
  double measure;     /**< area or volume */
  double low[3];      /**< bounding box; third coordinate 0 in 2D */
  double high[3];
  /** Rows: the vectors of a lattice as given, or the edges of a periodic box along its periodic axes and 0
   * along the others: the units of shifts. All 0 unless periodic. */
  double periods[3][3];
  size_t region_count; /**< convex pieces, triangles or tetrahedra that were kept; 0 for a solid */
} pc_domain_info;

/** Two elements of a mesh, triangles or tetrahedra, that overlap. */
typedef struct pc_overlap {
  uint32_t first, second; /**< indices of the input, ascending */
  double measure;         /**< of their common part: an area or a volume */
  double at[3];           /**< the centroid of that part */
} pc_overlap;

/** The elements of a mesh that were left out, and those that overlap. Empty for polygons and boxes. */
typedef struct pc_mesh_report {
  size_t flat_count;
  const uint32_t* flat; /**< elements without area or volume, left out */
  size_t repeated_count;
  const uint32_t* repeated; /**< rows: an element left out, and the earlier one with the same corners */
  size_t overlaps;          /**< pairs of the others that overlap; their common part counts twice */
  double overlap;           /**< the sum of the measures of the common parts */
  pc_overlap largest;       /**< the pair with the largest common part */
  size_t note_count;
  const char* const* notes; /**< the same as sentences, one for each kind of fault */
} pc_mesh_report;

typedef enum pc_region_shape {
  PC_REGION_POLYGON = 0, /**< convex, vertices counter-clockwise (surface: a triangle as oriented) */
  PC_REGION_TETRAHEDRON, /**< positively oriented */
  PC_REGION_BOX          /**< 8 corners, corner k at (x: k&1, y: k&2, z: k&4), low where the bit is 0 */
} pc_region_shape;

/** The convex regions of a domain; none for a solid. Region r has the vertices region_vertex[region_offset[r]
 * .. region_offset[r+1]) and the facets [facet_offset[r], facet_offset[r+1]): of a polygon, edge k from its
 * vertex k to vertex k+1; of a tetrahedron, facet k opposite vertex k; of a box, -x +x -y +y -z +z. */
typedef struct pc_regions {
  pc_region_shape shape;
  int dimension; /**< coordinates of a vertex */
  int cell_dimension;
  size_t count; /**< regions */
  size_t vertex_count;
  const double* vertices;        /**< vertex_count x dimension, row-major */
  const uint32_t* region_offset; /**< count + 1 */
  const uint32_t* region_vertex; /**< indices of vertices */
  const uint32_t* facet_offset;  /**< count + 1 */
  const pc_border* facet;        /**< a boundary facet and its number, or interior and the region behind it */
  const uint32_t* source;        /**< count: the input part, triangle or tetrahedron */
  uint32_t boundary_count;       /**< boundary facets */
} pc_regions;

/** Area or volume. */
POWERCELL_API pc_status pc_domain_measure(const pc_domain* domain, double* measure);
/** What the domain is; lasts as long as the handle. */
POWERCELL_API pc_status pc_domain_info_view(const pc_domain* domain, const pc_domain_info** info);
/** What was left out of a mesh; lasts as long as the handle. */
POWERCELL_API pc_status pc_domain_report_view(const pc_domain* domain, const pc_mesh_report** report);
/** The convex regions; last as long as the handle. */
POWERCELL_API pc_status pc_domain_regions_view(const pc_domain* domain, const pc_regions** regions);

/** Points moved by whole periods into the domain, but for rounding: the positions that diagrams compute
 * with. In domains that are not periodic they stay.
 * \param positions  count x dimension, row-major
 * \param wrapped    count x dimension; may be the same array */
POWERCELL_API pc_status pc_domain_wrap(const pc_domain* domain, const double* positions, size_t count,
                                       double* wrapped);
/** Random points uniform in area or volume; the same ones for the same random seed on every machine.
 * \param region  count: the region of each point, 0 in a solid; may be NULL
 * \param points  count x dimension, row-major */
POWERCELL_API pc_status pc_domain_random_points(const pc_domain* domain, size_t count, uint64_t random_seed,
                                                uint32_t* region, double* points);

#ifdef __cplusplus
}
#endif
#endif
