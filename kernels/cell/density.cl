/* Integrals over a cell of a density that is affine in the region, piece by piece as the moments are found
   (docs/mathematics.md (33a)). */
#ifndef POWERCELL_CELL_DENSITY
#define POWERCELL_CELL_DENSITY
#include "cell/cell.cl"

/* value + gradient.(y - corner) */
typedef struct {
  real value;
  real4 gradient, corner; /* of the first corner, relative to what the vertices are */
} density_t;

/* \param region  DENSITY_SIZE reals of the region (diagram/density.cl) */
static inline density_t density_of(const vertices_t* p, __global const stored_real* region) {
  density_t density;
  density.value = region[DENSITY_VALUE];
  density.gradient =
      make_real4(region[DENSITY_GRADIENT], region[DENSITY_GRADIENT + 1], region[DENSITY_GRADIENT + 2], 0);
  density.corner = region_corner(p, 0);
  return density;
}

static inline real density_at(density_t density, real4 y) {
  return density.value + dot3(density.gradient, y - density.corner);
}

#if CELL_DIMENSION == 3

/* Adds the integrals over the tetrahedron of `top` and the triangle a, v, w in the face of that height, as
   tetrahedron_moments: to `mass` that of 24 rho, to sums those of 120 rho y, and in the last component and in
   `squares` parts of that of 720 rho |y|^2. */
static inline void tetrahedron_density(density_t density, real4 top, real4 a, real4 v, real4 w, real4 height,
                                       real* mass, real4* sums, real4* squares) {
  real part = 0;
  real4 first = make_real4(0, 0, 0, 0), second = first;
  tetrahedron_moments(top, a, v, w, height, &part, &first, &second);
  const real at_top = density_at(density, top), at_a = density_at(density, a), at_v = density_at(density, v),
             at_w = density_at(density, w), total = (at_top + at_a) + (at_v + at_w);
  const real4 sum = (top + a) + (v + w), weighted = (top * at_top + a * at_a) + (v * at_v + w * at_w);
  *mass += part * total;
  *sums = *sums + (sum * total + weighted) * part;
  *squares = *squares + (sum * total + weighted * 2) * sum * part;
  (*sums).w += weighted.w * part;
}

/* The integrals of rho, rho y and rho |y|^2. Needs cell_moments. */
static inline void cell_density_moments(const cell_t* cell, density_t density, real* moments) {
  const int words = words_of(&cell->at);
  int first = 0;
  for (int w = words - 1; w >= 0; --w)
    if (cell->at.used[w] != 0) first = w * WORD_BITS + lowest_bit(cell->at.used[w]);
  const real4 top = cell->point[first];
  real4 sums = make_real4(0, 0, 0, 0), squares = sums;
  real mass = 0;
  for (int w = 0; w < words; ++w)
    for (ulong bits = cell->at.used[w]; bits != 0; bits &= bits - 1) {
      const int v = w * WORD_BITS + lowest_bit(bits);
      UNROLL for (int k = 0; k < 3; ++k) {
        const int f = cell->face[v][k];
        tetrahedron_density(density, top, cell->point[cell->mark[f]], cell->point[v],
                            cell->point[cell->next[v][k]], cell->normal[f], &mass, &sums, &squares);
      }
    }
  moments[0] = mass / 24;
  moments[1] = sums.x / 120;
  moments[2] = sums.y / 120;
  moments[DIMENSION] = sums.z / 120;
  moments[1 + DIMENSION] = (sums.w + squares.x + squares.y + squares.z) / 720;
}

#else

static inline real4 density_point(const cell_t* cell, int v) {
  return make_real4(cell->at.x[0][v], cell->at.x[1][v], DIMENSION == 3 ? cell->at.x[DIMENSION - 1][v] : 0, 0);
}

/* Adds the integrals of rho, rho y and rho |y|^2 over triangle (a, b, c), as triangle_moments. */
static inline void triangle_density(const cell_t* cell, density_t density, int a, int b, int c,
                                    real* moments) {
  real part[2 + DIMENSION], sums = 0, squares = 0, weighted_sums = 0, weighted_squares = 0;
  UNROLL for (int k = 0; k < 2 + DIMENSION; ++k) part[k] = 0;
  triangle_moments(cell, a, b, c, part);
  const real area = part[0], at_a = density_at(density, density_point(cell, a)),
             at_b = density_at(density, density_point(cell, b)),
             at_c = density_at(density, density_point(cell, c)), total = at_a + at_b + at_c;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    const real p = cell->at.x[k][a], q = cell->at.x[k][b], r = cell->at.x[k][c], sum = p + q + r,
               weighted = p * at_a + q * at_b + r * at_c;
    moments[1 + k] += area * (sum * total + weighted) / 12;
    sums += sum * sum;
    weighted_sums += weighted * sum;
    squares += p * p + q * q + r * r;
    weighted_squares += p * p * at_a + q * q * at_b + r * r * at_c;
  }
  moments[0] += area * total / 3;
  moments[1 + DIMENSION] += area * (total * (sums + squares) + 2 * (weighted_sums + weighted_squares)) / 60;
}

/* The integrals of rho, rho y and rho |y|^2. */
static inline void cell_density_moments(const cell_t* cell, density_t density, real* moments) {
  UNROLL for (int k = 0; k < 2 + DIMENSION; ++k) moments[k] = 0;
  const int first = cell->first;
  for (int v = cell->next[first], w = cell->next[v]; w != first; v = w, w = cell->next[v])
    triangle_density(cell, density, first, v, w, moments);
}

#endif

#endif
