/* Plain structs and codes that C++ and OpenCL C both compile. */
#ifndef POWERCELL_LAYOUT_H
#define POWERCELL_LAYOUT_H

/* What became of a (region, seed) piece. */
#define PIECE_WHOLE 0   /* clipped, nothing can cut it any more */
#define PIECE_EMPTY 1   /* the seed has no part in the region */
#define PIECE_FLAT 2    /* touches the region only: walls count, measures do not */
#define PIECE_MORE 3    /* the neighbour list ended before the stopping rule held */
#define PIECE_FULL 4    /* does not fit this variant's capacity */
#define PIECE_TANGLED 5 /* rounding made the cut topologically impossible */

/* What a cut did. */
#define CUT_NONE 0
#define CUT_SHRUNK 1
#define CUT_EMPTY 2
#define CUT_FULL 3
#define CUT_TANGLED 4

/* What a clip kernel writes besides the status: a sum of these is its define OUTPUTS. */
#define OUTPUT_MOMENTS 1
#define OUTPUT_WALLS 2
#define OUTPUT_GEOMETRY 4

/* A border below 0 is facet slot ~border of the region, else the rank of the neighbour. */

/* The polyhedron a volume region starts as: a 3-regular graph. Seen from outside, the neighbours
   next[0..2][v] of vertex v go counter-clockwise, and face[k][v] lies between next[k][v] and
   next[k+1][v]. */
#define SHAPE_VERTICES 8
typedef struct {
  int vertices;
  int faces;
  int next[3][SHAPE_VERTICES];
  int face[3][SHAPE_VERTICES];
} region_shape_t;

#endif
