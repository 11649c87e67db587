/// \file
/// A few points out of many.
#pragma once

#include <cstddef>
#include <vector>

namespace powercell {

/// Random points that are drawn to choose one of.
inline constexpr std::size_t points_to_choose_from = 16;

/// n of the points, spread as the points are: these are halved n - 1 times across their longest extent, and
/// of each part the one nearest to the mean is taken. Parts of a domain that are apart so get numbers of
/// points near their shares, unlike with independent random points.
/// \param points  at least n, row-major
std::vector<double> even_points(const std::vector<double>& points, std::size_t dimension, std::size_t n);

}  // namespace powercell
