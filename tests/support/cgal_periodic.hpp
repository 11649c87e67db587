/// \file
/// CGAL's periodic triangulations behind a plain header: they take long to compile.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "tests/support/generators.hpp"

namespace powercell::test {

/// A corner of a simplex: a seed and its image, in periods.
using PeriodicCorner = std::pair<std::uint32_t, std::array<std::int32_t, 3>>;

/// The simplices of the periodic triangulation of the unit square (Delaunay, weights 0) or the unit cube
/// (regular, weights in [0, 1/64)), one of the images of each, corners in any order. \param seeds  in the
/// unit box, in general position
std::vector<std::vector<PeriodicCorner>> cgal_periodic_simplices(const SeedArray& seeds);

}  // namespace powercell::test
