/// \file
/// Checks shared by meshes of triangles and of tetrahedra.
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

}  // namespace powercell
