/* Plain structs and codes that C++ and OpenCL C both compile. */
#ifndef POWERCELL_LAYOUT_H
#define POWERCELL_LAYOUT_H

/* What became of a (region, seed) piece. */
#define PIECE_DONE 0    /* clipped, nothing can cut it any more */
#define PIECE_EMPTY 1   /* the seed has no part in the region */
#define PIECE_FLAT 2    /* touches the region only: walls count, measures do not */
#define PIECE_MORE 3    /* the neighbour list ended before the stopping rule held */
#define PIECE_FULL 4    /* does not fit this variant's capacity */
#define PIECE_TANGLED 5 /* for the host: rounding made a cut impossible, or too many seeds come near */
/* Added to one of the first three: rounding may have decided (docs/mathematics.md, "Certain decisions"). */
#define PIECE_UNCERTAIN 8

/* Instead of a pair, for a row of which nothing is wanted. */
#define NO_PAIR 0xffffffffu

/* What a cut did. */
#define CUT_NONE 0
#define CUT_SHRUNK 1
#define CUT_EMPTY 2
#define CUT_FULL 3
#define CUT_TANGLED 4
#define CUT_TOUCH 5  /* nothing cut off, but a face may lie in the cutting plane */
#define CUT_WITHIN 6 /* the whole cell lies in the cutting plane, to rounding */

/* What became of a seed (powercell::SeedStatus, then what only a diagram in device memory can meet). */
#define SEED_OK 0
#define SEED_HIDDEN 1
#define SEED_DUPLICATE 2
#define SEED_INVALID 3    /* not finite, or out of the range in which squares are finite */
#define SEED_UNFINISHED 4 /* a piece fits no variant on the device, or no memory was set aside for it */
#define SEED_MERGED 5     /* a duplicate in the device's numbers, but not in the caller's: reported as one */

/* The frame of a scene in device memory: FRAME_SIZE reals (lib/domain/frame.hpp). */
#define FRAME_CENTRE 0     /* 3: high parts of the centre */
#define FRAME_CENTRE_LOW 3 /* 3: low parts (0 in double precision) */
#define FRAME_SCALE 6      /* a power of two */
#define FRAME_UNIT 7       /* 1 / scale */
#define FRAME_SIZE 8

/* The lattice of a periodic domain in integers (lib/domain/period_grid.hpp): PERIOD_SIZE 64-bit numbers.
   Lengths are in quanta, of which each coordinate has its own. c: coordinate, k: vector. */
#define PERIOD_COUNT 0   /* vectors */
#define PERIOD_IS_BOX 1  /* 1: each vector is along an axis */
#define PERIOD_ROUNDED 2 /* c: 1 if seeds are wrapped and rounded along it */
#define PERIOD_QUANTUM 5 /* c: exponent of the quantum, a power of two */
#define PERIOD_ORIGIN 8  /* c: of the part that seeds are wrapped into, a whole number */
#define PERIOD_RANGE 11  /* c: coordinates of seeds that are not too far are below 2^this */
#define PERIOD_VECTOR 14 /* 3k + c */
/* 3k + c: the dual vectors, for coordinates below 2^PERIOD_WORD; k: fractional bits of products with them. */
#define PERIOD_DUAL 23
#define PERIOD_BITS 32
#define PERIOD_GIVEN 35  /* 3k + c: the vector in those given by the user */
#define PERIOD_CENTRE 44 /* c: centre of the frame, in halves of a quantum */
#define PERIOD_UNIT 47   /* c: exponent of half a quantum in the frame */
#define PERIOD_SIZE 50
#define PERIOD_WORD 61        /* bits of a coordinate: a sum of three products has no more than 64 */
#define PERIOD_FINE 26        /* more bits of a coordinate near the origin */
#define PERIOD_SLACK_BITS 30  /* images within 2^-this of a border of the part may be on either side */
#define PERIOD_MOST (1 << 28) /* vectors from the origin to a seed */

/* The same in reals of the frame: EXTENT_SIZE. */
#define EXTENT_SPACING 0 /* k: between planes of the lattice along vector k */
#define EXTENT_REACH 3   /* k: Period::reach() */
#define EXTENT_MEASURE 6 /* of the domain */
#define EXTENT_SIZE 7

/* The images that are made: MARGIN_SIZE reals (kernels/periodic/margin.cl). */
#define MARGIN_WIDTH 0
#define MARGIN_WEIGHT 1 /* the largest weight of a seed */
#define MARGIN_SIZE 2

/* Shifts of images, from -SHIFT_MOST to SHIFT_MOST along each vector, and how many they are. */
#define SHIFT_MOST 3
#define SHIFT_SIDE (2 * SHIFT_MOST + 1)
#define SHIFT_COUNT (SHIFT_SIDE * SHIFT_SIDE * SHIFT_SIDE)

/* What seeds are sorted by, the least significant first. */
#define KEY_WEIGHT 0 /* the largest first */
#define KEY_HASH 1   /* brings equal positions together */
#define KEY_FINE 2   /* Hilbert curve within a grid cell */
#define KEY_COARSE 3 /* Hilbert curve over all seeds */

/* What a clip kernel writes besides the status: a sum of these is its argument. */
#define OUTPUT_MOMENTS 1
#define OUTPUT_WALLS 2
#define OUTPUT_GEOMETRY 4
#define OUTPUT_LIST_USE 8 /* how far the neighbour lists were read (kernels/clip/by_list.cl only) */
#define OUTPUT_REACH 16   /* the distance of the farthest vertex from the seed */
#define OUTPUT_FACETS 32  /* the facets of the region among the walls, as with geometry */
#define OUTPUT_SIDES 64   /* measures of walls, left in the cell (kernels/device_diagram/clip_pairs.cl) */

/* Which faces of a piece are written: a sum of these, or all. */
#define FACES_WALLS 1
#define FACES_BOUNDARY 2 /* facets of the region that bound the domain */
#define FACES_ALL 7

/* Added to the index of a facet of the domain's boundary, among walls: seeds have lower numbers. */
#define ENTRY_FACET 0x80000000u

/* Where decisions are left to rounding: a wall that only one of two cells has is no wall if it is at most
   this part of the largest wall of either. */
#define NEGLIGIBLE_WALL_DOUBLE 1e-9
#define NEGLIGIBLE_WALL_FLOAT 1e-3f

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

/* Most leaves in the list of those near a leaf (neighbors/near.cl): with their eight seeds each they are
   numbered by 9 bits (TAG_BITS in base/lanes.cl). */
#define NEAR_MOST 64

/* The part of a cell's radius by which decisions about it must be clear, and within which its vertices are
   known: a power of one half (SEARCH_MARGIN in base/real.cl). */
#define MARGIN_BITS_DOUBLE 20
#define MARGIN_BITS_FLOAT 5

/* The kind of a border that is a wall (powercell::Border::Kind). */
#define BORDER_WALL 0

/* A density in a region, affine: DENSITY_SIZE reals (kernels/device_diagram/density.cl). */
#define DENSITY_VALUE 0    /* at its first corner; NaN where it is not known */
#define DENSITY_GRADIENT 1 /* 3 */
#define DENSITY_SIZE 4
/* No density is larger, so that its products with areas and squared distances stay in the range of numbers.
 */
#define LARGEST_DENSITY_DOUBLE 1e100
#define LARGEST_DENSITY_FLOAT 1e30f

/* Behind a facet of a region lies nothing, or a region: then the corner of it that is not on the facet
   (surfaces), or any number from 0. */
#define BEHIND_NOTHING (-1)

#endif
