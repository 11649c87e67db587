// Measures the highest rates of a device: copying memory, and multiplying and adding. Both results are known
// exactly, so that a launch that did not run cannot pass for a fast one. The host defines REAL_BITS (32, 64).
// Contraction is allowed here, since no side is decided.
#pragma OPENCL FP_CONTRACT ON

#ifndef REAL_BITS
#define REAL_BITS 32
#endif
#if REAL_BITS == 64
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double real;
typedef double2 packet; /* 16 bytes, the widest that GPUs load at once */
typedef double8 wide;   /* the widest register of CPUs */
#else
typedef float real;
typedef float4 packet;
typedef float16 wide;
#endif

// values[i] = i mod 8191: exact in either precision.
__kernel void fill(__global real* values, ulong count) {
  const ulong i = get_global_id(0);
  if (i < count) values[i] = (real)(i % 8191);
}

__kernel void copy(__global const packet* from, __global packet* to, ulong count) {
  const ulong i = get_global_id(0);
  if (i < count) to[i] = from[i];
}

// Eight chains x <- x * factor + step of `rounds` steps from start[i] + 0 .. 7, enough to hide the latency
// of one step behind the others, and their sum. With factor = step = 1, which no compiler knows, the sum is
// 8 start[i] + 28 + 8 rounds, exact while below 2^24.
__kernel void multiply_add(__global const wide* start, __global wide* sums, real factor, real step,
                           uint rounds, uint count) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  wide a = start[i], b = a + 1, c = a + 2, d = a + 3, e = a + 4, f = a + 5, g = a + 6, h = a + 7;
  for (uint r = 0; r < rounds; ++r) {
    a = a * factor + step;
    b = b * factor + step;
    c = c * factor + step;
    d = d * factor + step;
    e = e * factor + step;
    f = f * factor + step;
    g = g * factor + step;
    h = h * factor + step;
  }
  sums[i] = ((a + b) + (c + d)) + ((e + f) + (g + h));
}
