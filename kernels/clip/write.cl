/* Writing what was asked for of a clipped piece. */
#ifndef POWERCELL_CLIP_WRITE
#define POWERCELL_CLIP_WRITE
#include "cell/bisector.cl"
#include "cell/density.cl"

typedef struct {
  uint wanted;                         /* a sum of OUTPUT_...; the memory of others is not used */
  __global stored_real* moments;       /* per pair: measure, first moments, second moment, about the seed */
  __global uint* faces;                /* per row: faces written, all or (without geometry) the walls alone */
  __global int* border;                /* rows of FACE_CAPACITY */
  __global stored_real* wall;          /* rows of FACE_CAPACITY */
  __global uint* vertices;             /* per row: vertices written */
  __global stored_real* vertex;        /* rows of VERTEX_CAPACITY x DIMENSION, relative to the seed */
  __global uint* link;                 /* rows of VERTEX_CAPACITY x 6: next and face (polyhedra only) */
  __global stored_real* reach;         /* per row: of a cell that is done, before its vertices are improved */
#if WITH_DENSITY                       /* else these would be private memory of each work-item */
  __global const stored_real* density; /* of the region of the piece (cell/density.cl) */
  __global stored_real* density_moments; /* as `moments`, of the density */
#endif
} output_t;

#define MOMENTS (2 + DIMENSION)
/* Of the measure and, behind these, of the density. */
#define ALL_MOMENTS ((WITH_DENSITY ? 2 : 1) * MOMENTS)

/* All of them, about what the vertices are relative to; with `walls` the measures of walls too. */
static inline void find_moments(cell_t* cell, output_t out, bool walls, real* moments) {
  cell_moments(cell, walls, moments);
#if WITH_DENSITY
  cell_density_moments(cell, density_of(&cell->at, out.density), moments + MOMENTS);
#else
  (void)out;
#endif
}

/* Moments about the centre as those about the seed. */
static inline void leave_centre_of_moments(const vertices_t* p, const real* about, real* moments) {
  moments[0] = about[0];
  moments[1 + DIMENSION] = about[1 + DIMENSION];
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    const real c = p->centre[k];
    moments[1 + k] = about[1 + k] + c * about[0];
    moments[1 + DIMENSION] += c * (2 * about[1 + k] + c * about[0]);
  }
}

/* True if the cell is no thicker than the rounding errors of its vertices. */
static inline bool cell_is_flat(cell_t* cell, real measure) {
  real extent = 2 * cell->at.radius;
  const real thickness = 32 * REAL_EPSILON * cell->at.reach;
  if (measure > thickness * (CELL_DIMENSION == 3 ? extent * extent : extent)) return false;
  find_box(&cell->at);
  extent = 0;
  UNROLL for (int k = 0; k < DIMENSION; ++k) extent = fmax(extent, cell->at.high[k] - cell->at.low[k]);
  return !(measure > thickness * (CELL_DIMENSION == 3 ? extent * extent : extent));
}

/* Whether a piece that nothing can cut any more is what it would be without rounding: its own shape is
   certain, and no plane that cut nothing comes nearer than its vertices may be off. Its vertices are better
   afterwards. */
static inline bool done_is_certain(cell_t* cell) {
  if (!(cell->at.gap > 0))
    return false; /* before vertices move: a face that was touched has no plane to put them in */
  const real moved = cell_certain(cell), off = moved + cell->at.drift;
  if (!(moved >= 0 && off < cell->at.gap && 16 * moved < SEARCH_MARGIN * cell->at.radius)) return false;
  return off < cell->at.closest_gap || closest_is_clear(&cell->at);
}

/* Whether moments are in the range of numbers and the measure is at least `filling` of the square or cube of
   the radius. */
static inline bool measure_is_good(const cell_t* cell, real measure, real filling) {
  const real r = cell->at.radius;
  return measure >= fmax(REAL_LEAST, filling * (CELL_DIMENSION == 3 ? r * r * r : r * r));
}

/* In single precision a whole cell that is small beside its distance from the seed has a measure of too few
   digits. Computes it again, relative to a point inside the cell, whose shape is certain. False if it still
   is not good. */
static inline bool measure_closely(cell_t* cell, output_t out, bool walls, real* moments) {
  real about[ALL_MOMENTS];
  recentre(&cell->at);
  bool good = cell_certain(cell) >= 0;
  if (good) {
    find_moments(cell, out, walls, about);
    good = measure_is_good(cell, about[0], LEAST_CENTRED_FILLING);
    leave_centre_of_moments(&cell->at, about, moments);
    if (WITH_DENSITY) leave_centre_of_moments(&cell->at, about + MOMENTS, moments + MOMENTS);
  }
  leave_centre(&cell->at);
  return good;
}

/* Writes a piece that ended with `status`; returns the final status. */
static inline int write_piece(cell_t* cell, output_t out, int status, uint pair, uint row) {
  real moments[ALL_MOMENTS];
  const bool geometry = (out.wanted & OUTPUT_GEOMETRY) != 0,
             rows = geometry || (out.wanted & OUTPUT_WALLS) != 0,
             all = geometry || (out.wanted & OUTPUT_FACETS) != 0,
             sides = rows || (out.wanted & OUTPUT_SIDES) != 0;
  bool certain = cell->at.gap > 0;
  UNROLL for (int k = 0; k < ALL_MOMENTS; ++k) moments[k] = 0;
  if (status == PIECE_DONE) {
    find_radius2(&cell->at);
    certain = quickly_certain(&cell->at);
    if (out.wanted & OUTPUT_REACH) out.reach[row] = (stored_real)cell->at.radius;
    cell_finish(cell, !certain);
    certain = certain || done_is_certain(cell);
    find_moments(cell, out, sides, moments);
    if (certain && !measure_is_good(cell, moments[0], LEAST_FILLING) && !cell_goes_on(cell))
      certain = LEAST_FILLING > 0 && measure_closely(cell, out, sides, moments);
    if (cell_is_flat(cell, moments[0])) {
      status = PIECE_FLAT;
      certain = false;
      UNROLL for (int k = 0; k < ALL_MOMENTS; ++k) moments[k] = 0;
    }
    if (rows) {
      const size_t at = (size_t)row * FACE_CAPACITY;
      out.faces[row] =
          (uint)cell_write_walls(cell, all ? FACES_ALL : FACES_WALLS, out.border + at, out.wall + at);
    }
    if (geometry) {
      const size_t at = (size_t)row * VERTEX_CAPACITY;
      out.vertices[row] = (uint)cell_write_vertices(cell, out.vertex + at * DIMENSION, out.link + at * 6);
    }
  } else if (rows) {
    out.faces[row] = 0;
    if (geometry) out.vertices[row] = 0;
  }
  UNROLL for (int k = 0; k < MOMENTS; ++k) out.moments[(size_t)pair * MOMENTS + (size_t)k] =
      (stored_real)moments[k];
#if WITH_DENSITY
  UNROLL for (int k = 0; k < MOMENTS; ++k) out.density_moments[(size_t)pair * MOMENTS + (size_t)k] =
      (stored_real)moments[MOMENTS + k];
#endif
  return status <= PIECE_FLAT && !certain ? status | PIECE_UNCERTAIN : status;
}

#endif
