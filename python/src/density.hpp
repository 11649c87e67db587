/// \file
/// Densities from Python: a number, a formula, a function, an image or values at vertices.
#pragma once

#include <powercell/density.hpp>

#include "python/src/call.hpp"

namespace powercell::python {

/// \param given  a pair of the kind ("constant", "formula", "function", "image", "nodal") and its value, as
///   the package makes it; functions run within the call of the slot
Density density_of(const nb::tuple& given, CallSlot& slot, int dimension);

/// \param given  with the keys walls, walls_if (None or a function, which runs within the call of the slot),
///   tolerance, threads
IntegrationOptions integration_options(const nb::dict& given, CallSlot& slot);

}  // namespace powercell::python
