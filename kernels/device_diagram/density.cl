/* A density given by its values at the vertices of the domain's mesh. */
#include "base/lanes.cl"

/* Work-item r: the density in region r, a triangle or tetrahedron, in the unit of the frame. It is not known,
   and NaN, where the value at a corner is negative, above LARGEST_DENSITY or not finite. */
__kernel void affine_density(const uint regions, __global const seed_t* corners,
                             __global const uint* region_offset, __global const uint* region_vertex,
                             __global const stored_real* values, __global stored_real* density) {
  const uint r = (uint)get_global_id(0);
  if (r >= regions) return;
  __global const uint* corner = region_vertex + region_offset[r];
  __global stored_real* to = density + (size_t)r * DENSITY_SIZE;
  const seed_t first = corners[corner[0]];
  const real value = values[corner[0]];
  real size = 0, rise[3] = {0, 0, 0};
  real4 edge[3];
  bool known = value >= 0 && value <= LARGEST_DENSITY;
  edge[2] = make_real4(0, 0, 0, 0);
  UNROLL for (int k = 0; k < CELL_DIMENSION; ++k) {
    real d[DIMENSION];
    const real there = values[corner[k + 1]];
    difference(corners[corner[k + 1]], first, d);
    edge[k] = make_real4(d[0], d[1], DIMENSION == 3 ? d[DIMENSION - 1] : 0, 0);
    rise[k] = there - value;
    known = known && there >= 0 && there <= LARGEST_DENSITY;
    size = fmax(size, fmax(fabs(edge[k].x), fmax(fabs(edge[k].y), fabs(edge[k].z))));
  }
  /* In units of the region's size: products of four lengths may leave the range of numbers. */
  UNROLL for (int k = 0; k < 3; ++k) edge[k] = edge[k] / size;
  if (CELL_DIMENSION == 2) edge[2] = cross3(edge[0], edge[1]); /* the density is constant along the normal */
  const real4 n0 = cross3(edge[1], edge[2]), n1 = cross3(edge[2], edge[0]), n2 = cross3(edge[0], edge[1]);
  const real4 gradient = (n0 * rise[0] + n1 * rise[1] + n2 * rise[2]) / dot3(edge[0], n0) / size;
  known =
      known && fabs(gradient.x) <= REAL_MAX && fabs(gradient.y) <= REAL_MAX && fabs(gradient.z) <= REAL_MAX;
  to[DENSITY_VALUE] = known ? value : (real)NAN;
  to[DENSITY_GRADIENT] = gradient.x;
  to[DENSITY_GRADIENT + 1] = gradient.y;
  to[DENSITY_GRADIENT + 2] = gradient.z;
}
