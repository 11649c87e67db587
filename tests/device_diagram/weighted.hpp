/// \file
/// Masses of cells in device memory, compared with those that the host integrates.
#pragma once

#include <powercell/density.hpp>
#include <vector>

#include "tests/device_diagram/caller.hpp"
#include "tests/support/generators.hpp"

namespace powercell::test {

/// Values at the vertices of a mesh, from 0 to 2, a quarter of them 0, at least one positive.
std::vector<double> random_values(const Domain& mesh, Random& random);
/// An affine density at the vertices of a mesh: a + b.x
std::vector<double> linear_values(const Domain& mesh, double a, const std::array<double, 3>& b);

/// Results of the device with a density, which is set for the call alone.
Output run_with(Caller& caller, DeviceDiagram& diagram, const SeedsView& seeds,
                std::span<const double> values);
/// Integrals of the host over the cells of a Diagram with exact decisions. \param precision  of the Diagram
DensityIntegrals host_integrals(Caller& caller, const Domain& domain, const SeedsView& seeds,
                                std::span<const double> values, Precision precision);

/// Compares the integrals, of cells that are there for both, within `error` of the mean mass at the largest
/// value and of the size of the domain.
/// \return how many seeds differ or are unfinished
std::size_t differences(const Output& found, const DensityIntegrals& expected, const Domain& domain,
                        double largest, double error);

/// The same bits, or NaN on both sides, in row i.
bool same_row(const Output& a, const Output& b, std::size_t i);

}  // namespace powercell::test
