/// \file
/// Seeds whose cells have equal mass: the transport variant.
#pragma once

#include <powercell/device.hpp>

#include "lib/applications/remeshing/progress.hpp"
#include "lib/applications/remeshing/sampling.hpp"

namespace powercell::remeshing {

/// Moves the free seeds to the centroids of cells of equal mass for the density h^-2, projected to the
/// surface, at most `rounds` times, until they move by less than some hundredths of h. The cells are found by
/// powercell::TransportSolver. Seeds on kept curves stay, with the share of a cell that their angle is.
/// \return the places of the free seeds
/// \throw Error not_converged, interrupted, and what TransportSolver throws
std::vector<Place> spread_evenly(const Sampling& sampling, const Sizing& sizing, const Device& device,
                                 int rounds, Progress progress = {});

}  // namespace powercell::remeshing
