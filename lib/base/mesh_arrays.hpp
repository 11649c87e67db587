/// \file
/// What every domain has to keep, and every list of triangles that is not made into one (remeshing).
#pragma once

#include <cstdint>
#include <powercell/error.hpp>
#include <span>
#include <string>

namespace powercell {

/// \param vertices nv x 3   \param elements rows of `corners` indices
/// \param element, elements_name e.g. "triangle", "triangles"
/// \throw Error invalid_domain: sizes, which vertex is not finite, which element has which bad index
void check_simplices(std::span<const double> vertices, std::span<const std::uint32_t> elements, int corners,
                     const std::string& element, const std::string& elements_name);

/// Refuses a domain whose largest coordinate is not within 10^-100 .. 10^100, where neither volumes nor the
/// rounding errors of areas leave the range of double. \throw Error invalid_domain
void check_magnitude(double largest);

}  // namespace powercell
