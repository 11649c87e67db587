/// \file
/// The inner loops of the search in lists, over seeds in columns, compiled for several vector units.
///
///
/// There is a column for each coordinate, then one for the weight. The loops subtract `origin` from the
/// coordinates; points and boxes are relative to it.
#pragma once

#include <cstddef>

namespace powercell::pairs::loops {

/// Power distances from `point`: |x_s - point|^2 (1 - square) - (w_s + weight |w_s| + constant), or the
/// lowest double where that is not finite, so that comparisons never meet NaN.
void powers(std::size_t count, int dimension, const double* const* column, const double* origin,
            const double* point, double square, double weight, double constant, double* to);

/// excess[s] = max(excess[s], min over v of (lower[v][s] - upper[v]))
void raise_excess(std::size_t count, std::size_t corners, const double* const* lower, const double* upper,
                  double* excess);

/// excess[s] = max(excess[s], min of pow_s - pow_t over the box [0, size] - rounding), by (10) with the
/// tester t in place of the cell's seed.
/// \param tester  coordinates relative to the origin, then the weight
void raise_box_excess(std::size_t count, int dimension, const double* const* column, const double* origin,
                      const double* size, const double* tester, double* excess);

/// The same for nodes, with the minimum over the box and all seeds s of the node, by (9).
/// \param column  the low coordinates of the nodes, the high ones, then the largest weights
void raise_node_excess(std::size_t count, int dimension, const double* const* column, const double* size,
                       const double* tester, double* excess);

/// The first index of the least value.
/// \pre count > 0
std::size_t least(std::size_t count, const double* values);

}  // namespace powercell::pairs::loops
