/// \file
/// The connected parts of a domain.
#pragma once

#include <cstdint>
#include <powercell/domain.hpp>
#include <vector>

#include "lib/applications/transport/domain_points.hpp"

namespace powercell {

/// Per region of the domain the part that it lies in: regions that interior facets connect.
struct DomainParts {
  std::vector<std::uint32_t> of_region;
  std::uint32_t count = 0;
};

DomainParts domain_parts(const Domain& domain);

/// Joins parts, so that at most `most` are left, each to the nearest of the largest.
void join_small(DomainParts& parts, const DomainPoints& points, std::uint32_t most);

}  // namespace powercell
