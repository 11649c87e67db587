/// \file
/// Cells as simplices, and how much of them an affine function cuts off.
#pragma once

#include <array>
#include <cstdint>
#include <powercell/results.hpp>
#include <span>
#include <vector>

namespace powercell {

struct CellSimplex {
  std::uint32_t cell;
  std::array<std::uint32_t, 4> vertex;
  int corners;
  double mass;
};

struct CellSimplices {
  std::vector<std::array<double, 3>> vertex;
  std::vector<std::uint32_t> owner;  ///< per vertex: the cell
  std::vector<CellSimplex> simplex;
};

/// Cuts each piece of each cell into simplices.
/// \param mass  of each cell; spread evenly over it
CellSimplices cut_into_simplices(const Cells& cells, std::span<const double> mass);

/// The share of a simplex in which an affine function with these values at its corners is below t.
double share_below(std::array<double, 4> value, int corners, double t);

}  // namespace powercell
