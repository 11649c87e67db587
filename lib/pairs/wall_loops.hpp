/// \file
/// The inner loops of the search by cells: bisectors against eight boxes or regions, compiled for several
/// vector units. Internal.
#pragma once

#include <cstddef>

#include "lib/regions/region_blocks.hpp"

namespace powercell::pairs::loops {

/// The bisector of a cell and a neighbour: beyond it is 2 q.y > level, y relative to the cell's seed.
struct Bisector {
  std::array<double, 3> q;
  double offset;     ///< |q|^2 + w_i - w_j
  double magnitude;  ///< sum of the absolute terms of the offset
};

/// beyond[lane] = max over the walls of (least of 2 q.y - level over box `lane`), less the rounding: above 0
/// the box has nothing of the cell, (11) of the mathematics. reach[w * 8 + lane] = greatest of the same for
/// wall w, with the rounding: below 0 the wall does not come near the box. \param box   low, then high
/// coordinates \param seed  of the cell
void test_boxes(const Bisector* bisector, std::size_t bisectors, int dimension, const Lanes* box,
                const double* seed, Lanes& beyond, double* greatest);

/// The same for the hulls of `corners` corners each, in these boxes.
void test_corners(const Bisector* bisector, std::size_t bisectors, int dimension, const Lanes* box,
                  const Lanes* corner, std::size_t corners, const double* seed, Lanes& beyond,
                  double* greatest);

/// The least of direction . vertex over `count` vertices, a multiple of the lanes, coordinate after
/// coordinate.
double least_along(const double* direction, int dimension, const double* vertex, std::size_t count);

}  // namespace powercell::pairs::loops
