/// \file
/// A tiny diagram with known measures, computed with each clip program before its first use, to detect
/// drivers that miscompile it.
#pragma once

#include <powercell/domain.hpp>

#include "lib/domain/region_mesh.hpp"
#include "lib/neighbors/candidates.hpp"
#include "lib/scene/variant.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// The domain of the diagram: the unit square or cube, or as a surface the square in the plane z = 1/4.
RegionMesh golden_mesh(const Variant& variant);
/// Two layers of seeds along each axis, whose cells are boxes, or rectangles on a surface.
SeedSet golden_seeds(int dimension);
/// The measure of the cell of seed `s`.
double golden_measure(const Variant& variant, std::uint32_t s);

/// The same domain as two triangles of a surface, or six tetrahedra.
/// \pre variant.dimension is 3
Domain golden_simplices(const Variant& variant);
/// A density at the vertices of those: 1 + x + 2 y + 3 z.
std::vector<double> golden_densities(const Domain& simplices);
/// The mass of the cell of seed `s` with that density.
double golden_mass(const Variant& variant, std::uint32_t s);

/// \param s         the seed
/// \param found     measure or mass of its cell, as computed
/// \param expected  the known one
/// \param program   for the message
/// \throw Error self_test_failed if it is wrong
void require_golden(const cl::Context& context, std::string_view program, const Variant& variant,
                    std::uint32_t s, double found, double expected);

/// Clips the golden diagram, with all outputs, with the program of `variant`.
/// \param capacity  of the variant: its number in capacities()
/// \throw Error self_test_failed, naming the device, the variant and the wrong measure
void golden_test(const std::shared_ptr<cl::Context>& context, const Candidates& candidates,
                 const Variant& variant, std::size_t capacity);

}  // namespace powercell
