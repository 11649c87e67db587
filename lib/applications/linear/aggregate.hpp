/// \file
/// Which unknowns of a Laplacian are joined on the next level. Internal.
#pragma once

#include "lib/applications/linear/laplacian.hpp"

namespace powercell {

struct Aggregates {
  std::int32_t count = 0;
  std::vector<std::int32_t> of;  ///< per unknown: its aggregate
  std::vector<char> strong;      ///< per entry of the matrix, in its order: whether it couples strongly
};

/// Joins each unknown with its strong neighbours (Vanek, Mandel, Brezina 1996, algorithm 5.1), in the order
/// of the unknowns. Entries below a fraction of both rows' largest are weak.
Aggregates aggregate(const SparseRows& matrix, int level);

}  // namespace powercell
