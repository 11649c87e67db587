/// \file
/// Clusters of seeds. Internal.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace powercell {

using Clusters = std::vector<std::vector<std::uint32_t>>;  ///< per cluster its seeds

/// Divides seeds into at most `count` clusters of about equal sums of `size`, apart from seeds that are larger
/// alone: halves the largest across its longest side until there are as many.
/// \param positions  n x d, of different seeds
/// \param size       n, positive
Clusters cluster_seeds(std::span<const double> positions, std::size_t d, std::span<const double> size,
                       std::size_t count);

}  // namespace powercell
