/// \file
/// A tiny diagram with a known answer, computed with each clip program before its first use, so that a
/// driver that miscompiles it is refused and not believed.
#pragma once

#include "lib/domain/region_mesh.hpp"
#include "lib/neighbors/candidates.hpp"
#include "lib/scene/variant.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// The known diagram for the dimensions of a variant: two layers of seeds along each axis of the unit square
/// or cube, whose cells are boxes (on a surface, the square in the plane z = 1/4: rectangles).
RegionMesh golden_mesh(const Variant& variant);
SeedSet golden_seeds(int dimension);
/// Measure of the cell of seed `s`.
double golden_measure(const Variant& variant, std::uint32_t s);
/// Throws self_test_failed for the cell of seed `s` unless it measures what it must.
/// \param program  for the message
void require_golden(const cl::Context& context, std::string_view program, const Variant& variant,
                    std::uint32_t s, double measure);

/// Clips two layers of seeds along each axis, whose cells are boxes known in closed form, with the
/// program of `variant` (number `capacity` of capacities()).
/// \throw Error self_test_failed naming the device, the variant and the wrong figure
void golden_test(const std::shared_ptr<cl::Context>& context, const Candidates& candidates,
                 const Variant& variant, std::size_t capacity);

}  // namespace powercell
