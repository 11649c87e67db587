/// \file
/// Checks of the arrays that describe a mesh, for domains and for remeshing.
#pragma once

#include <cstdint>
#include <powercell/error.hpp>
#include <span>
#include <string>

namespace powercell {

/// Checks the arrays of a mesh of triangles or tetrahedra.
/// \param vertices nv x 3
/// \param elements rows of `corners` indices
/// \param element, elements_name e.g. "triangle", "triangles", for messages
/// \throw Error invalid_domain: wrong sizes, a coordinate that is not finite, an index out of range (the
/// first)
void check_simplices(std::span<const double> vertices, std::span<const std::uint32_t> elements, int corners,
                     const std::string& element, const std::string& elements_name);

/// \param largest  the largest magnitude of a coordinate of the domain
/// \throw Error invalid_domain unless it is within 10^-100 .. 10^100, where neither volumes nor the rounding
/// errors of areas leave the range of double
void check_magnitude(double largest);

}  // namespace powercell
