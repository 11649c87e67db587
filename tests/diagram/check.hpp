/// \file
/// The common body of the diagram tests: compares all results of a diagram to brute force.
#pragma once

#include <powercell/diagram.hpp>

#include "tests/support/brute_force.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

namespace powercell::test {

enum class Position {
  general,     ///< random seeds: the dual is compared as well
  degenerate,  ///< ties are expected, so that the simplices of the dual are not unique
};

/// Compares a diagram of `seeds` on `domain` in one setup.
void check_diagram(const Setup& setup, const Domain& domain, const SeedArray& seeds,
                   const ReferenceDiagram& reference, Position position);

/// Computes the reference, and compares in every setup.
void check_everywhere(const Domain& domain, const SeedArray& seeds, Position position);

}  // namespace powercell::test
