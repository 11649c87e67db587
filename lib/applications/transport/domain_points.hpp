/// \file
/// Points that stand for the measure of a domain.
#pragma once

#include <powercell/domain.hpp>
#include <vector>

#include "lib/applications/transport/soft_transport.hpp"

namespace powercell {

struct DomainPoints {
  Weighted points;                    ///< weights 0
  std::vector<std::uint32_t> region;  ///< per point
};

/// Points on regular grids in the regions of a domain, each with its
/// share of the measure: about `count`, at least one a region.
DomainPoints domain_points(const Domain& domain, std::size_t count);

}  // namespace powercell
