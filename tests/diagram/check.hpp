/// \file
/// The one body of the diagram tests: everything a diagram gives back, against brute force.
#pragma once

#include <powercell/diagram.hpp>

#include "tests/support/brute_force.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

namespace powercell::test {

enum class Position {
  general,     ///< random seeds: the dual is compared as well
  degenerate,  ///< ties are expected: which cells touch in a corner is anybody's choice
};

/// Compares a diagram of `seeds` on `domain` in one setup.
void check_diagram(const Setup& setup, const Domain& domain, const SeedArray& seeds,
                   const ReferenceDiagram& reference, Position position);

/// Makes the reference and compares in every setup.
void check_everywhere(const Domain& domain, const SeedArray& seeds, Position position);

}  // namespace powercell::test
