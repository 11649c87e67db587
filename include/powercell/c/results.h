/** \file
 * The results of a diagram. Rows keep the order of the seeds, or of the selected ones.
 */
#ifndef POWERCELL_C_RESULTS_H
#define POWERCELL_C_RESULTS_H

#include <powercell/c/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/** State of a seed. */
typedef enum pc_seed_status {
  PC_SEED_OK = 0,   /**< the cell has a positive measure */
  PC_SEED_HIDDEN,   /**< the cell restricted to the domain is empty */
  PC_SEED_DUPLICATE /**< another at the same position has a larger weight, or the same and a lower index */
} pc_seed_status;

/** Integrals over each cell. n rows, d coordinates. */
typedef struct pc_measures {
  size_t count;                /**< n */
  int dimension;               /**< d */
  const double* mass;          /**< n: area or volume of the cell; 0 where empty */
  const double* centroid;      /**< n x d, row-major; NaN where the cell is empty */
  const double* second_moment; /**< n: integral of |x - p_i|^2 over the cell */
  const uint8_t* status;       /**< n: a pc_seed_status each */
  size_t status_count[3];      /**< seeds of each pc_seed_status */
  double domain_measure;
  double total;          /**< sum of the masses, compensated */
  double relative_error; /**< |total - domain_measure| / domain_measure */
} pc_measures;

/** The pairs of cells that share a wall inside the domain, as compressed sparse rows. Symmetric: j is in row
 * i with the same wall measure as i in row j, with the opposite shift. */
typedef struct pc_adjacency {
  size_t count;             /**< n */
  size_t entry_count;       /**< offset[n] */
  const uint64_t* offset;   /**< n + 1; row i is [offset[i], offset[i+1]) */
  const uint32_t* neighbor; /**< per entry, ascending within a row */
  const double* wall;       /**< per entry: length (polygon, surface) or area (volume) of the wall */
  /** In a periodic domain (else NULL), 3 per entry: the image of the neighbour, in periods of the domain
   * (pc_domain_info). The wall is with the neighbour as given, moved by the sum of shift[k] times period k. A
   * seed may occur several times in a row, with ascending shifts, and so may the row's own seed. */
  const int32_t* shift;
  double asymmetry;       /**< largest |a_ij - a_ji| before the two sides were averaged */
  uint32_t asymmetric[2]; /**< i and j of that difference; equal if there was none */
} pc_adjacency;

/** The parts of the domain's boundary that belong to each cell, as compressed sparse rows. In a box of space
 * the facets are -x +x -y +y -z +z, in one of the plane -y +x +y -x; else they have the numbers of
 * pc_regions. */
typedef struct pc_boundary_walls {
  size_t count;           /**< n */
  size_t entry_count;     /**< offset[n] */
  const uint64_t* offset; /**< n + 1 */
  const uint32_t* facet;  /**< per entry, ascending within a row */
  const double* measure;  /**< per entry: length (polygon, surface) or area (volume) of the part */
} pc_boundary_walls;

typedef enum pc_border_kind {
  PC_BORDER_WALL = 0, /**< the cell of seed `index` */
  PC_BORDER_BOUNDARY, /**< the outside: facet `index` of the domain's boundary */
  PC_BORDER_INTERIOR  /**< the same cell, in region `index` of the domain */
} pc_border_kind;

/** The other side of a face of a cell. This struct does not grow. */
typedef struct pc_border {
  uint32_t kind; /**< a pc_border_kind */
  uint32_t index;
} pc_border;

/** The geometry of the cells as convex pieces, one for each region of the domain that a cell meets. Cell i
 * owns the pieces [cell_offset[i], cell_offset[i+1]). Piece p has the vertices [vertex_offset[p],
 * vertex_offset[p+1]) and the faces [face_offset[p], face_offset[p+1]). For polygons and surfaces a face is
 * an edge: face k of a piece goes from its vertex k to its vertex k+1 (cyclic), counter-clockwise. For
 * volumes face f is the polygon loop[loop_offset[f] .. loop_offset[f+1]), indices from 0 within the piece's
 * vertices, counter-clockwise seen from outside. */
typedef struct pc_cells {
  size_t count; /**< n */
  size_t piece_count, vertex_count, face_count;
  int dimension;                 /**< d, coordinates of a vertex */
  int cell_dimension;            /**< 2 or 3 */
  const uint64_t* cell_offset;   /**< n + 1 */
  const uint32_t* region;        /**< per piece: the region of the domain it lies in */
  const uint64_t* vertex_offset; /**< pieces + 1 */
  const double* vertices;        /**< row-major, d per vertex */
  const uint64_t* face_offset;   /**< pieces + 1 */
  const pc_border* border;       /**< per face */
  const int32_t* shift;          /**< 3 per face in a periodic domain, as in pc_adjacency; else NULL */
  const uint64_t* loop_offset;   /**< faces + 1 (volumes only, else NULL) */
  const uint32_t* loop;          /**< volumes only, else NULL */
} pc_cells;

/** Cells joined across the regions of the domain: the faces of a cell share vertices, and the faces between
 * its pieces are removed. Cell i owns the vertices [vertex_offset[i], vertex_offset[i+1]) and the faces
 * [face_offset[i], face_offset[i+1]); face f is loop[loop_offset[f] .. loop_offset[f+1]), indices from 0
 * within the cell's vertices. Polygon: the faces of a cell are its boundary rings, outer ones
 * counter-clockwise, holes clockwise. Surface: a face is a polygon in one triangle of the domain. Volume and
 * solid: a face is a polygon on the cell's boundary, counter-clockwise seen from outside.
 * powercell::JoinedCells says more. */
typedef struct pc_joined_cells {
  size_t count; /**< n */
  size_t vertex_count, face_count, loop_count;
  int dimension;
  int cell_dimension;
  const uint64_t* vertex_offset; /**< n + 1 */
  const double* vertices;        /**< row-major, d per vertex */
  const uint64_t* face_offset;   /**< n + 1 */
  const pc_border* face_border;  /**< per face (volumes only, else NULL) */
  const uint64_t* loop_offset;   /**< faces + 1 */
  const uint32_t* loop;          /**< loop_count */
  const pc_border*
      edge_border;      /**< per loop entry: of the edge that starts there (polygons and surfaces only) */
  const int32_t* shift; /**< 3 per border in a periodic domain, as in pc_adjacency; else NULL */
} pc_joined_cells;

/** The regular triangulation restricted to the domain, or of the whole space. */
typedef struct pc_dual {
  size_t count;              /**< simplices */
  int corners;               /**< 3 or 4 */
  const uint32_t* simplices; /**< count rows of `corners` seed indices, positively oriented, rows ascending */
  /** 3 per corner in a periodic domain (else NULL): the image of the seed. Of the simplices that translations
   * make of one another there is one, whose first corner has the shift 0. */
  const int32_t* shift;
} pc_dual;

/** Seconds spent in each part of the last computation, and counts. */
typedef struct pc_timings {
  double total;        /**< seeds in host memory to results in host memory, kernels built before */
  double prepare;      /**< validation, duplicates, ordering, tree */
  double pairs;        /**< which seeds meet which regions */
  double neighbors;    /**< neighbour lists on the host (FLANN) */
  double clip;         /**< kernels */
  double collect;      /**< results on the host */
  double certify;      /**< checking laws (pc_options.certify) */
  double build;        /**< compiling kernels (not in total) */
  uint64_t pair_count; /**< candidate (region, seed) pairs */
  uint64_t retried;    /**< pairs that needed a larger capacity */
  uint64_t on_host;    /**< pairs that ended on the host */
  uint64_t uncertain;  /**< pairs in which rounding may have decided */
  uint64_t rounds;     /**< rounds of neighbour lists (FLANN) */
} pc_timings;

#ifdef __cplusplus
}
#endif
#endif
