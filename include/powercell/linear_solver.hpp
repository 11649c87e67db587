/// \file
/// Choice of the solver for the linear systems of optimal transport.
#pragma once

#include <powercell/export.hpp>

namespace powercell {

/// Solver for the linear system of a Newton step.
enum class LinearSolver {
  automatic,   ///< chosen by the number of seeds and the dimension of the cells
  dense,       ///< Cholesky on a full matrix, for up to some hundred seeds
  direct,      ///< sparse Cholesky
  multilevel,  ///< conjugate gradients, preconditioned by smoothed aggregation
};

/// Stable lower-case name, e.g. "multilevel".
POWERCELL_API const char* name(LinearSolver solver) noexcept;

}  // namespace powercell
