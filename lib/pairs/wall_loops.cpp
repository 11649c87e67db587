#include "lib/pairs/wall_loops.hpp"

#include <cmath>
#include <limits>

#include "lib/base/compiler.hpp"
#include "lib/base/vector_copies.hpp"

namespace powercell::pairs::loops {
namespace {

/// Relative to the absolute terms: coordinates relative to the seed, products and sums round less than 16
/// times.
constexpr double rounding = 0x1p-48;
constexpr double infinite = std::numeric_limits<double>::infinity();
/// With larger terms nothing is excluded.
constexpr double largest = std::numeric_limits<double>::max();
/// For the absolute errors of subnormal terms.
constexpr double tiny = std::numeric_limits<double>::min();

using lanes::load, lanes::store, lanes::Vector;

/// A bound for the error of 2 q.y - offset at all points of eight boxes, or infinity.
template <int D>
POWERCELL_ALWAYS_INLINE void find_error(const Bisector& bisector, const Vector (&extent)[D], Vector& error) {
  error = Vector{} + bisector.magnitude;
  for (int k = 0; k < D; ++k) error += std::fabs(bisector.q[k]) * extent[k];
  error = error <= largest ? rounding * error + tiny : Vector{} + infinite;
}

/// Twice the largest distance of a point of the box from the seed, along each axis.
template <int D>
POWERCELL_ALWAYS_INLINE void find_extent(const Lanes* box, const double* seed, Vector (&extent)[D]) {
  for (int k = 0; k < D; ++k) {
    Vector a, b;
    load(&box[k], a);
    load(&box[D + k], b);
    a = seed[k] - a;
    b = b - seed[k];
    extent[k] = 2 * (a > b ? a : b);
  }
}

/// Records one bisector: 2 q.y - offset is within [least, most] in each lane, up to its error.
POWERCELL_ALWAYS_INLINE void record(const Vector& least, const Vector& most, const Vector& error,
                                    Vector& beyond, double* greatest) {
  const Vector none = Vector{} - infinite;
  const Vector value = error <= largest ? least - error : none;
  beyond = value > beyond ? value : beyond;
  store(error <= largest ? most + error : -none, greatest);
}

template <int D>
POWERCELL_ALWAYS_INLINE void boxes_in(const Bisector* bisector, std::size_t bisectors, const Lanes* box,
                                      const double* seed, Lanes& beyond, double* greatest) {
  Vector low[D], high[D], extent[D], farthest = Vector{} - infinite;
  find_extent<D>(box, seed, extent);
  for (int k = 0; k < D; ++k) {
    load(&box[k], low[k]);
    load(&box[D + k], high[k]);
    low[k] = 2 * (low[k] - seed[k]);
    high[k] = 2 * (high[k] - seed[k]);
  }
  for (std::size_t j = 0; j < bisectors; ++j) {
    const Bisector& by = bisector[j];
    Vector least = Vector{} - by.offset, most = least, error;
    for (int k = 0; k < D; ++k) {
      const Vector a = by.q[k] * low[k], b = by.q[k] * high[k];
      least += a < b ? a : b;
      most += a < b ? b : a;
    }
    find_error<D>(by, extent, error);
    record(least, most, error, farthest, greatest + j * lane_count);
  }
  store(farthest, &beyond);
}

template <int D>
POWERCELL_ALWAYS_INLINE void corners_in(const Bisector* bisector, std::size_t bisectors, const Lanes* box,
                                        const Lanes* corner, std::size_t corners, const double* seed,
                                        Lanes& beyond, double* greatest) {
  Vector extent[D], farthest = Vector{} - infinite;
  find_extent<D>(box, seed, extent);
  for (std::size_t j = 0; j < bisectors; ++j) {
    const Bisector& by = bisector[j];
    Vector least = Vector{} + infinite, most = -least, error;
    for (std::size_t c = 0; c < corners; ++c) {
      Vector side{}, x;
      for (int k = 0; k < D; ++k) {
        load(&corner[c * D + static_cast<std::size_t>(k)], x);
        side += by.q[k] * (x - seed[k]);
      }
      least = side < least ? side : least;
      most = side > most ? side : most;
    }
    find_error<D>(by, extent, error);
    least = 2 * least - by.offset;
    most = 2 * most - by.offset;
    record(least, most, error, farthest, greatest + j * lane_count);
  }
  store(farthest, &beyond);
}

template <int D>
POWERCELL_ALWAYS_INLINE double least_in(const double* direction, const double* vertex, std::size_t count) {
  Vector least = Vector{} + infinite;
  for (std::size_t v = 0; v < count; v += lane_count) {
    Vector sum{}, x;
    for (int k = 0; k < D; ++k) {
      load(&vertex[static_cast<std::size_t>(k) * count + v], x);
      sum += direction[k] * x;
    }
    least = sum < least ? sum : least;
  }
  double all = infinite;
  for (std::size_t l = 0; l < lane_count; ++l) all = least[l] < all ? least[l] : all;
  return all;
}

}  // namespace

POWERCELL_VECTOR_COPIES void test_boxes(const Bisector* bisector, std::size_t bisectors, int dimension,
                                        const Lanes* box, const double* seed, Lanes& beyond,
                                        double* greatest) {
  if (dimension == 2)
    boxes_in<2>(bisector, bisectors, box, seed, beyond, greatest);
  else
    boxes_in<3>(bisector, bisectors, box, seed, beyond, greatest);
}

POWERCELL_VECTOR_COPIES void test_corners(const Bisector* bisector, std::size_t bisectors, int dimension,
                                          const Lanes* box, const Lanes* corner, std::size_t corners,
                                          const double* seed, Lanes& beyond, double* greatest) {
  if (dimension == 2)
    corners_in<2>(bisector, bisectors, box, corner, corners, seed, beyond, greatest);
  else
    corners_in<3>(bisector, bisectors, box, corner, corners, seed, beyond, greatest);
}

POWERCELL_VECTOR_COPIES double least_along(const double* direction, int dimension, const double* vertex,
                                           std::size_t count) {
  return dimension == 2 ? least_in<2>(direction, vertex, count) : least_in<3>(direction, vertex, count);
}

}  // namespace powercell::pairs::loops
