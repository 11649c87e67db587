/// \file
/// Seeds in another order, and results brought back to the first one.
#pragma once

#include "tests/support/generators.hpp"
#include "tests/support/same_bits.hpp"

namespace powercell::test {

/// The place that each seed of a permuted set had before.
using Permutation = std::vector<std::uint32_t>;
Permutation random_permutation(std::size_t n, Random& random);

SeedArray permuted(const SeedArray& seeds, const Permutation& from);

/// Results of permuted seeds as if the seeds were in their first order.
Measures restored(const Measures& measures, const Permutation& from);
Adjacency restored(const Adjacency& adjacency, const Permutation& from);
Cells restored(const Cells& cells, const Permutation& from);
Dual restored(const Dual& dual, const Permutation& from);
Results restored(const Results& results, const Permutation& from);

}  // namespace powercell::test
