/// \file
/// Levels of clusters of seeds.
#pragma once

#include <vector>

#include "lib/applications/transport/soft_transport.hpp"

namespace powercell {

/// The seeds, clusters of them, clusters of these and so on, until they are at most 150. Clusters have their
/// mean positions and the sums of their masses; all weights are 0.
std::vector<Weighted> seed_levels(Weighted seeds, std::size_t d);

}  // namespace powercell
