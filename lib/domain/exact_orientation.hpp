/// \file
/// The orientation of a simplex without rounding, for where rounding leaves it open. Internal.
#pragma once

#include <cstdint>
#include <span>

namespace powercell {

/// Sign of the determinant of the edges from the first corner. \param corners  d+1 indices of rows of
/// `positions`
int exact_orientation(std::span<const double> positions, std::span<const std::uint32_t> corners);

}  // namespace powercell
