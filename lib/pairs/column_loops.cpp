#include "lib/pairs/column_loops.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "lib/base/compiler.hpp"
#include "lib/base/vector_copies.hpp"

namespace powercell::pairs::loops {
namespace {

constexpr double greatest = std::numeric_limits<double>::max();
constexpr double unit_roundoff = 0x1p-53;

template <int D>
POWERCELL_ALWAYS_INLINE void powers_in(std::size_t count, const double* const* column, const double* origin,
                                       const double* point, double square, double weight, double constant,
                                       double* POWERCELL_RESTRICT to) {
  const double* POWERCELL_RESTRICT x[D + 1];
  for (int k = 0; k <= D; ++k) x[k] = column[k];
  for (std::size_t s = 0; s < count; ++s) {
    double sum = 0;
    for (int k = 0; k < D; ++k) {
      const double t = (x[k][s] - origin[k]) - point[k];
      sum += t * t;
    }
    const double w = x[D][s];
    const double power = sum * (1 - square) - (w + weight * std::fabs(w) + constant);
    to[s] = std::fabs(power) <= greatest ? power : -greatest;
  }
}

/// Ascending with x, for x that is not NaN. The minimum of integers does not depend on the order of
/// comparisons, so compilers vectorise it.
POWERCELL_ALWAYS_INLINE std::int64_t ordered_bits(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x);
  return bits ^ (bits >> 63 & std::numeric_limits<std::int64_t>::max());
}

template <std::size_t C>
POWERCELL_ALWAYS_INLINE void raise_corners(std::size_t count, const double* const* lower, const double* upper,
                                           double* POWERCELL_RESTRICT excess) {
  const double* POWERCELL_RESTRICT value[C];
  for (std::size_t v = 0; v < C; ++v) value[v] = lower[v];
  for (std::size_t s = 0; s < count; ++s) {
    double low = value[0][s] - upper[0];
    for (std::size_t v = 1; v < C; ++v) {
      const double d = value[v][s] - upper[v];
      low = d < low ? d : low;
    }
    excess[s] = low > excess[s] ? low : excess[s];
  }
}

template <int D>
POWERCELL_ALWAYS_INLINE void raise_box(std::size_t count, const double* const* column, const double* origin,
                                       const double* size, const double* t,
                                       double* POWERCELL_RESTRICT excess) {
  const double* POWERCELL_RESTRICT x[D + 1];
  for (int k = 0; k <= D; ++k) x[k] = column[k];
  double t2 = 0, reach2 = 0;
  for (int k = 0; k < D; ++k) t2 += t[k] * t[k], reach2 += size[k] * size[k];
  // The last term bounds the absolute error of subnormal squares.
  const double fixed = t2 + std::fabs(t[D]) + reach2 + std::numeric_limits<double>::min() / unit_roundoff;
  for (std::size_t s = 0; s < count; ++s) {
    double s2 = 0, most = 0;
    for (int k = 0; k < D; ++k) {
      const double at = x[k][s] - origin[k], along = at - t[k];
      s2 += at * at;
      most += (along > 0 ? along : 0.0) * size[k];
    }
    // Every term, and the error of a coordinate times its factor, is below a few roundings of
    // |s|^2 + |t|^2 + |size|^2 and the weights.
    const double error = 64 * unit_roundoff * (s2 + std::fabs(x[D][s]) + fixed);
    const double value = ((s2 - x[D][s]) - (t2 - t[D])) - 2 * most - error;
    excess[s] = value > excess[s] ? value : excess[s];
  }
}

template <int D>
POWERCELL_ALWAYS_INLINE void raise_nodes(std::size_t count, const double* const* column, const double* size,
                                         const double* t, double* POWERCELL_RESTRICT excess) {
  const double* POWERCELL_RESTRICT x[2 * D + 1];
  for (int k = 0; k <= 2 * D; ++k) x[k] = column[k];
  double fixed = std::fabs(t[D]) + std::numeric_limits<double>::min() / unit_roundoff;
  for (int k = 0; k < D; ++k) fixed += 2 * (t[k] * t[k] + size[k] * size[k]);
  for (std::size_t s = 0; s < count; ++s) {
    double value = t[D] - x[2 * D][s], square = 0;
    for (int k = 0; k < D; ++k) {
      const double a = x[k][s], b = x[D + k][s];
      const double low = a > 0 ? a : (b < 0 ? b : 0.0);
      const double high = a > size[k] ? a - size[k] : (b < size[k] ? b - size[k] : 0.0);
      const double at_low = low * low - t[k] * t[k];
      const double at_high = high * high - (size[k] - t[k]) * (size[k] - t[k]);
      value += at_low < at_high ? at_low : at_high;
      square += a * a + b * b;
    }
    value -= 64 * unit_roundoff * (square + std::fabs(x[2 * D][s]) + fixed);
    excess[s] = value > excess[s] ? value : excess[s];
  }
}

}  // namespace

POWERCELL_VECTOR_COPIES void powers(std::size_t count, int dimension, const double* const* column,
                                    const double* origin, const double* point, double square, double weight,
                                    double constant, double* to) {
  if (dimension == 2)
    powers_in<2>(count, column, origin, point, square, weight, constant, to);
  else
    powers_in<3>(count, column, origin, point, square, weight, constant, to);
}

POWERCELL_VECTOR_COPIES void raise_excess(std::size_t count, std::size_t corners, const double* const* lower,
                                          const double* upper, double* excess) {
  switch (corners) {
    case 2:
      return raise_corners<2>(count, lower, upper, excess);
    case 3:
      return raise_corners<3>(count, lower, upper, excess);
    case 4:
      return raise_corners<4>(count, lower, upper, excess);
    case 5:
      return raise_corners<5>(count, lower, upper, excess);
    case 6:
      return raise_corners<6>(count, lower, upper, excess);
    case 7:
      return raise_corners<7>(count, lower, upper, excess);
    default:
      return raise_corners<8>(count, lower, upper, excess);
  }
}

POWERCELL_VECTOR_COPIES void raise_box_excess(std::size_t count, int dimension, const double* const* column,
                                              const double* origin, const double* size, const double* tester,
                                              double* excess) {
  if (dimension == 2)
    raise_box<2>(count, column, origin, size, tester, excess);
  else
    raise_box<3>(count, column, origin, size, tester, excess);
}

POWERCELL_VECTOR_COPIES void raise_node_excess(std::size_t count, int dimension, const double* const* column,
                                               const double* size, const double* tester, double* excess) {
  if (dimension == 2)
    raise_nodes<2>(count, column, size, tester, excess);
  else
    raise_nodes<3>(count, column, size, tester, excess);
}

POWERCELL_VECTOR_COPIES std::size_t least(std::size_t count, const double* values) {
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (std::size_t s = 0; s < count; ++s) least = std::min(least, ordered_bits(values[s]));
  const auto none = static_cast<std::int64_t>(count);
  std::int64_t first = none;
  for (std::int64_t s = 0; s < none; ++s) {
    const std::int64_t place = ordered_bits(values[s]) == least ? s : none;
    first = place < first ? place : first;
  }
  return static_cast<std::size_t>(first);
}

}  // namespace powercell::pairs::loops
