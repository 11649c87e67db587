// Small computations with known results, which test on each device the operations that the clipping kernels
// rely on; lib/cl/self_test.cpp computes the same on the host. The host defines SELF_TEST_DOUBLE=1
// where the device has double precision.
#pragma OPENCL FP_CONTRACT OFF

#ifndef SELF_TEST_DOUBLE
#define SELF_TEST_DOUBLE 0
#endif
#if SELF_TEST_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif

// operands: 3 per item (a, b, c; b > 0). results: 7 per item:
// a*b + c rounded twice, fma(a, b, c), a/b, sqrt(b), -1 where NaN and infinity behave, a*b - b*a, 1/b (for
// which compilers have shortcuts).
// A macro, so that one program serves both precisions: a second one would double the time of the test.
#define ARITHMETIC(name, number)                                                                        \
  __kernel void name(__global const number* operands, __global number* results, uint count) {           \
    const uint i = get_global_id(0);                                                                    \
    if (i >= count) return;                                                                             \
    const number a = operands[3 * i], b = operands[3 * i + 1], c = operands[3 * i + 2];                 \
    const number zero = a - a; /* not a constant that could be folded */                                \
    const number infinite = b / zero;                                                                   \
    const number undefined = zero / zero;                                                               \
    const int sane = undefined != undefined && !(undefined < a) && !(undefined >= a) && infinite > a && \
                     -infinite < a && isinf(infinite) && isnan(infinite - infinite);                    \
    __global number* out = results + 7 * i;                                                             \
    out[0] = a * b + c;                                                                                 \
    out[1] = fma(a, b, c);                                                                              \
    out[2] = a / b;                                                                                     \
    out[3] = sqrt(b);                                                                                   \
    out[4] = sane ? (number)-1 : (number)1;                                                             \
    out[5] = a * b - b * a;                                                                             \
    out[6] = 1 / b;                                                                                     \
  }

ARITHMETIC(arithmetic_float, float)
#if SELF_TEST_DOUBLE
ARITHMETIC(arithmetic_double, double)
#endif

// Divergent loops, a private array with computed indices, 64-bit integers and an atomic counter.
// keys: 8 per item, sorted by insertion into results[0..8); results[8] is the number of steps of
// n -> n/2 or 3n + 1 from keys[0] + 1 to 1, results[9] a product of 64 bits folded to 32.
// odd counts the items with an odd number of steps.
__kernel void control(__global const uint* keys, __global uint* results, __global uint* odd, uint count) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  uint sorted[8];
  for (int k = 0; k < 8; ++k) {
    const uint key = keys[8 * i + k];
    int at = k;
    while (at > 0 && sorted[at - 1] > key) {
      sorted[at] = sorted[at - 1];
      --at;
    }
    sorted[at] = key;
  }
  for (int k = 0; k < 8; ++k) results[10 * i + k] = sorted[k];

  ulong n = (ulong)keys[8 * i] + 1;
  uint steps = 0;
  for (; n != 1; ++steps) {
    if (n % 2 == 0) {
      n /= 2;
    } else {
      n = 3 * n + 1;
    }
  }
  results[10 * i + 8] = steps;
  if (steps % 2 == 1) atomic_inc(odd);

  const ulong product = ((ulong)keys[8 * i + 1] + 0x100000001UL) * 0x9e3779b97f4a7c15UL;
  results[10 * i + 9] = (uint)(product >> 32) ^ (uint)product;
}
