/// \file
/// Seeds in another order, and their results in the original order.
#pragma once

#include "tests/support/generators.hpp"
#include "tests/support/same_bits.hpp"

namespace powercell::test {

/// The original index of each seed of a permuted set.
using Permutation = std::vector<std::uint32_t>;
Permutation random_permutation(std::size_t n, Random& random);

SeedArray permuted(const SeedArray& seeds, const Permutation& from);

/// The results of permuted seeds, as for seeds in the original order.
Measures restored(const Measures& measures, const Permutation& from);
Adjacency restored(const Adjacency& adjacency, const Permutation& from);
Cells restored(const Cells& cells, const Permutation& from);
Dual restored(const Dual& dual, const Permutation& from);
Results restored(const Results& results, const Permutation& from);

}  // namespace powercell::test
