/// \file
/// The inner loops of the search by cells: the bisectors of a cell's walls against eight boxes or regions,
/// compiled for several vector units.
#pragma once

#include <cstddef>

#include "lib/regions/region_blocks.hpp"

namespace powercell::pairs::loops {

/// The bisector of a cell and a neighbour: 2 q.y <= offset is the cell's side, y relative to the cell's seed.
struct Bisector {
  std::array<double, 3> q;
  double offset;     ///< |q|^2 + w_i - w_j
  double magnitude;  ///< sum of the absolute terms of the offset
};

/// Bounds 2 q.y - offset over eight boxes.
/// \param box       low, then high coordinates
/// \param seed      of the cell
/// \param beyond    set to the maximum over the bisectors of the least value in each box, minus its error:
///                  if positive, the box lies outside the cell (11)
/// \param greatest  set at [8 j + lane] to the greatest value of bisector j in each box, plus its error: if
///                  negative, the bisector does not meet the box
void test_boxes(const Bisector* bisector, std::size_t bisectors, int dimension, const Lanes* box,
                const double* seed, Lanes& beyond, double* greatest);

/// The same for the hulls of `corners` corners each; `box` contains them.
void test_corners(const Bisector* bisector, std::size_t bisectors, int dimension, const Lanes* box,
                  const Lanes* corner, std::size_t corners, const double* seed, Lanes& beyond,
                  double* greatest);

/// The least of direction . vertex over `count` vertices.
/// \param vertex  all x, all y, all z
/// \pre `count` is a multiple of lane_count
double least_along(const double* direction, int dimension, const double* vertex, std::size_t count);

}  // namespace powercell::pairs::loops
