/// \file
/// The inner loops of the search in lists: over seeds in columns, compiled for several vector units.
/// Columns are coordinate after coordinate, then the weight; the origin is taken off the coordinates, and
/// points and boxes are relative to it. Internal.
#pragma once

#include <cstddef>

namespace powercell::pairs::loops {

/// Power distances from `point`: |x_s - point|^2 (1 - square) - (w_s + weight |w_s| + constant), or the least
/// double where that is not finite, so that comparisons never see NaN.
void powers(std::size_t count, int dimension, const double* const* column, const double* origin,
            const double* point, double square, double weight, double constant, double* to);

/// excess[s] = max(excess[s], min over v of (lower[v][s] - upper[v]))
void raise_excess(std::size_t count, std::size_t corners, const double* const* lower, const double* upper,
                  double* excess);

/// excess[s] = max(excess[s], least of pow_s - pow_t over the box [0, size]), less a bound of the rounding:
/// mathematics (10) with the tester t in place of the cell's seed.
/// \param tester  coordinates relative to the origin, then the weight
void raise_box_excess(std::size_t count, int dimension, const double* const* column, const double* origin,
                      const double* size, const double* tester, double* excess);

/// The same for nodes, with the least of pow_s - pow_t over the box and the seeds s of the node: (9).
/// \param column  dimension low coordinates, dimension high ones, then the largest weight
void raise_node_excess(std::size_t count, int dimension, const double* const* column, const double* size,
                       const double* tester, double* excess);

/// The first index of the least value; count > 0.
std::size_t least(std::size_t count, const double* values);

}  // namespace powercell::pairs::loops
