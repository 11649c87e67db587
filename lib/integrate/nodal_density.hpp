/// \file
/// Integrals over cells of a density given at the vertices of the domain's mesh.
#pragma once

#include <powercell/domain.hpp>
#include <powercell/results.hpp>
#include <span>
#include <vector>

namespace powercell {

/// Of the density rho over each cell, in the order of the cells.
struct NodalIntegrals {
  std::vector<double> mass;           ///< integral of rho; 0 without a cell
  std::vector<double> centroid;       ///< cells x d: integral of rho x, over the mass; NaN unless that is > 0
  std::vector<double> second_moment;  ///< integral of rho |x - p|^2, p the seed of the cell
};

/// Integrates a density that is affine in each triangle or tetrahedron (docs/mathematics.md (33a)). All
/// integrals of a cell are NaN if it has a piece in a region with a value that is negative, not finite or
/// above `largest`.
/// \param domain   of the cells; require_simplices() (lib/base/nodal_values.hpp) accepts it
/// \param values   one per vertex of the domain's mesh
/// \param largest  value that a density may have
/// \param seeds    cells x d, row-major: the positions of their seeds
/// \param threads  that share the cells; results do not depend on it
NodalIntegrals integrate_nodal(const Cells& cells, const Domain& domain, std::span<const double> values,
                               double largest, std::span<const double> seeds, int threads);

}  // namespace powercell
