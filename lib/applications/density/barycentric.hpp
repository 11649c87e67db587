/// \file
/// Parts of a simplex, given by the barycentric coordinates of their corners.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

#include "lib/applications/density/simplex_rule.hpp"

namespace powercell {

constexpr std::size_t most_corners = 4;  // of a tetrahedron
/// The corners of a part of the simplex that has its dimension or one less.
using Corners = std::array<Barycentric, most_corners>;
/// A value for each pair of corners.
template <class T>
using ByCorners = std::array<std::array<T, most_corners>, most_corners>;

/// The point at fraction `at` of the way from a to b.
inline Barycentric between(const Barycentric& a, const Barycentric& b, double at) {
  Barycentric point;
  for (std::size_t c = 0; c < point.size(); ++c) point[c] = (1 - at) * a[c] + at * b[c];
  return point;
}

/// The determinant of the first `size` coordinates of the first `size` rows, by elimination.
inline double determinant(std::size_t size, Corners row) {
  double product = 1;
  for (std::size_t k = 0; k < size; ++k) {
    std::size_t pivot = k;
    for (std::size_t r = k + 1; r < size; ++r)
      if (std::abs(row[r][k]) > std::abs(row[pivot][k])) pivot = r;
    if (row[pivot][k] == 0) return 0;
    if (pivot != k) {
      std::swap(row[pivot], row[k]);
      product = -product;
    }
    product *= row[k][k];
    for (std::size_t r = k + 1; r < size; ++r) {
      const double factor = row[r][k] / row[k][k];
      for (std::size_t c = k; c < size; ++c) row[r][c] -= factor * row[k][c];
    }
  }
  return product;
}

/// Calls `body(path)` for each monotone lattice path from the first row and column to the last. These paths
/// are the simplices of the standard triangulation of the product of two simplices, one with the rows and one
/// with the columns as corners.
template <class Body>
void for_paths(std::size_t rows, std::size_t columns, const Body& body) {
  const std::size_t steps = rows + columns - 2;
  for (unsigned down = 0; down < 1U << steps; ++down) {
    if (static_cast<std::size_t>(std::popcount(down)) != rows - 1) continue;
    std::array<std::pair<std::size_t, std::size_t>, most_corners> path{};
    for (std::size_t k = 0; k < steps; ++k) {
      path[k + 1] = path[k];
      ++(down >> k & 1 ? path[k + 1].first : path[k + 1].second);
    }
    body(path);
  }
}

}  // namespace powercell
