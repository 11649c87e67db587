/// \file
/// Diagrams against CGAL's regular triangulation (exact predicates), without a tolerance: all of its
/// simplices with their centre inside the domain must be there, and nothing that CGAL lacks.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <powercell/results.hpp>
#include <utility>
#include <vector>

#include "tests/support/cgal.hpp"
#include "tests/support/generators.hpp"

namespace powercell::bench {

using test::RegularTriangulation;
using test::SeedArray;

/// The domain, with room around the unit box for the corners of cells at the hull.
constexpr double low_side = -1.5, high_side = 2.5;
/// Simplices whose centre is this close to the boundary of the domain are not compared: rounding decides.
constexpr long double side_margin = 1e-9L;

struct Tally {
  std::size_t cells = 0, simplices = 0, walls = 0, hidden = 0, uncertain = 0;
  std::size_t missing_simplices = 0, extra_simplices = 0, missing_walls = 0, extra_walls = 0,
              wrong_hidden = 0;
  std::size_t differences() const {
    return missing_simplices + extra_simplices + missing_walls + extra_walls + wrong_hidden;
  }
};

using Simplex = std::array<std::uint32_t, 4>;  // ascending; in 2D the last is 2^32 - 1

inline std::vector<Simplex> simplices_of(const std::vector<std::uint32_t>& corners, std::size_t width) {
  std::vector<Simplex> all;
  for (std::size_t s = 0; s < corners.size(); s += width) {
    Simplex& simplex = all.emplace_back();
    simplex.fill(~std::uint32_t{0});
    std::copy_n(corners.begin() + static_cast<std::ptrdiff_t>(s), width, simplex.begin());
    std::sort(simplex.begin(), simplex.end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

enum class Place { inside, outside, at_side };

/// Where the centre of the simplex, the point of equal power distance to its corners, lies.
inline Place place_of(const Simplex& simplex, const SeedArray& seeds) {
  const int d = seeds.dimension;
  long double a[3][4];
  for (int r = 0; r < d; ++r) {
    long double offset = static_cast<long double>(seeds.weights[simplex[0]]) -
                         seeds.weights[simplex[static_cast<std::size_t>(r) + 1]];
    for (int k = 0; k < d; ++k) {
      const long double q =
          static_cast<long double>(seeds.coordinate(simplex[static_cast<std::size_t>(r) + 1], k)) -
          seeds.coordinate(simplex[0], k);
      a[r][k] = 2 * q;
      offset += q * q;
    }
    a[r][d] = offset;
  }
  for (int c = 0; c < d; ++c) {
    int best = c;
    for (int r = c + 1; r < d; ++r)
      if (std::abs(a[r][c]) > std::abs(a[best][c])) best = r;
    if (a[best][c] == 0) return Place::outside;
    std::swap(a[best], a[c]);
    for (int r = 0; r < d; ++r) {
      if (r == c) continue;
      const long double factor = a[r][c] / a[c][c];
      for (int k = c; k <= d; ++k) a[r][k] -= factor * a[c][k];
    }
  }
  Place place = Place::inside;
  for (int k = 0; k < d; ++k) {
    const long double x = a[k][d] / a[k][k] + seeds.coordinate(simplex[0], k);
    const long double in = std::min(x - low_side, high_side - x);
    if (in < -side_margin * (1 + std::abs(x))) return Place::outside;
    if (in < side_margin * (1 + std::abs(x))) place = Place::at_side;
  }
  return place;
}

/// What a diagram in the domain must have of a triangulation.
struct Inside {
  std::vector<Simplex> simplices;                               ///< with their centre inside, ascending
  std::vector<bool> met;                                        ///< by seed: whether one of them has it
  std::vector<std::pair<std::uint32_t, std::uint32_t>> needed;  ///< pairs of their corners, ascending
};

inline Inside inside_of(const std::vector<Simplex>& simplices, const SeedArray& seeds) {
  const auto width = static_cast<std::size_t>(seeds.dimension) + 1;
  Inside inside;
  inside.met.resize(seeds.size());
  for (const Simplex& simplex : simplices) {
    if (place_of(simplex, seeds) != Place::inside) continue;
    inside.simplices.push_back(simplex);
    for (std::size_t a = 0; a < width; ++a) {
      inside.met[simplex[a]] = true;
      for (std::size_t b = a + 1; b < width; ++b) inside.needed.emplace_back(simplex[a], simplex[b]);
    }
  }
  std::sort(inside.needed.begin(), inside.needed.end());
  inside.needed.erase(std::unique(inside.needed.begin(), inside.needed.end()), inside.needed.end());
  return inside;
}

/// Walls and hidden seeds of some cells, rows of neighbours by index.
/// \param seed  of each row
template <class Row, class Index>
void compare_rows(Tally& tally, const Inside& inside, const RegularTriangulation& cgal,
                  const std::vector<Row>& seed, const std::vector<SeedStatus>& status,
                  const std::vector<std::uint64_t>& offset, const std::vector<Index>& neighbor) {
  const auto row = [](const auto& offsets, const auto& neighbors, std::size_t k) {
    return std::pair(neighbors.begin() + static_cast<std::ptrdiff_t>(offsets[k]),
                     neighbors.begin() + static_cast<std::ptrdiff_t>(offsets[k + 1]));
  };
  for (std::size_t k = 0; k < seed.size(); ++k) {
    const auto i = static_cast<std::uint32_t>(seed[k]);
    const auto [begin, end] = row(offset, neighbor, k);
    const auto [from, to] = row(cgal.offset, cgal.neighbor, i);
    for (auto j = begin; j != end; ++j) tally.extra_walls += !std::binary_search(from, to, *j);
    for (auto j = from; j != to; ++j)
      if (std::binary_search(inside.needed.begin(), inside.needed.end(),
                             std::pair(std::min(i, *j), std::max(i, *j))))
        tally.missing_walls += !std::binary_search(begin, end, *j);
    const bool hidden = status[k] == SeedStatus::hidden;
    tally.hidden += hidden;
    tally.wrong_hidden += cgal.hidden[i] != 0 ? !hidden : hidden && inside.met[i];
  }
  tally.cells += seed.size();
  tally.walls += neighbor.size();  // from both sides
}

}  // namespace powercell::bench
