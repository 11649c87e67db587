/// \file
/// How many neighbours the paper's lists take for a diagram: counted, not timed. Uses library internals.
#pragma once

#include <powercell/diagram.hpp>

#include "lib/neighbors/list_candidates.hpp"

namespace powercell::paper {

/// \param options  initial_neighbors, lift_eta, twin_queries. In the device's best precision.
ListUse count_list_use(const Device& device, const Domain& domain, const SeedsView& seeds,
                       const Options& options);

}  // namespace powercell::paper
