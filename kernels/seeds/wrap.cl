/* Wraps the caller's seeds into a part of a periodic domain, and transforms them to the device's frame. */
#include "seeds/frame.cl"
#include "seeds/period.cl"

/* Arguments as of pack_seeds (pack.cl). Writes besides, for seeds that are valid: place, the coordinates as
   integers (count x DIMENSION), equal for equal positions alone: quanta, or along bounded axes the ordered
   bits of the coordinate; and shift, from there to the seed as given (count x 3). */
__kernel void wrap_seeds(const uint count, __global const stored_real* frame,
                         __global const stored_real* positions, __global const stored_real* weights,
                         const int weighted, __global const long* period, __global seed_t* points,
                         __global uint* status, __global long* place, __global int* shift) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  digits_t digits[DIMENSION];
  bool valid = true;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    digits[k] = digits_of(positions[(size_t)i * DIMENSION + (size_t)k]);
    valid = valid && digits[k].finite;
  }
  const place_t wrapped = wrap_point(digits, period);
  valid = valid && !wrapped.far;
  parts_t p = {{0, 0, 0, 0}, {0, 0, 0, 0}};
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    const real x = positions[(size_t)i * DIMENSION + (size_t)k];
    long number = wrapped.at[k];
    if (period[PERIOD_ROUNDED + k] != 0) {
      place_to_frame(number, period, k, &p.high[k], &p.low[k]);
    } else {
      to_frame(frame, x, k, &p.high[k], &p.low[k]);
      valid = valid && fabs(p.high[k]) <= MOST_COORDINATE;
      number = (long)ordered_bits(x);
    }
    place[(size_t)i * DIMENSION + (size_t)k] = number;
  }
  for (int m = 0; m < 3; ++m) shift[(size_t)i * 3 + (size_t)m] = (int)wrapped.shift[m];
  write_seed(i, p, valid, frame, weights, weighted, points, status);
}
