/// \file
/// Boxes that an option declares periodic.
#pragma once

#include <powercell/domain.hpp>

namespace powercell {

/// The domain, or if `periodic` and it is not periodic yet, its box with opposite sides identified.
/// \throw Error unsupported unless such a domain is a box
Domain periodic_domain(Domain domain, bool periodic);

}  // namespace powercell
