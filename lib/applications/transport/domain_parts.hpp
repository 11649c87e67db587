/// \file
/// The connected parts of a domain, and how cells lie in them. Internal.
#pragma once

#include <powercell/domain.hpp>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/applications/transport/normal.hpp"

namespace powercell {

/// Per region of the domain the part that it lies in: regions that interior facets connect.
struct DomainParts {
  std::vector<std::uint32_t> of_region;
  std::uint32_t count = 0;
};

DomainParts domain_parts(const Domain& domain);

/// What a cell has of one part.
struct PartOfCell {
  std::uint32_t part;
  double mass;
  Normal where;
};

/// Per cell its shares of the parts.
/// \param mass  of each cell; spread evenly over it
std::vector<std::vector<PartOfCell>> parts_of_cells(const Cells& cells, std::span<const double> mass,
                                                    const DomainParts& parts);

/// Joins parts, so that at most `most` are left, each to the nearest of the largest.
/// \param whole  each part as a whole
void join_small(DomainParts& parts, const std::vector<PartOfCell>& whole, std::uint32_t most);

}  // namespace powercell
