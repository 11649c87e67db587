/// \file
/// Seeds whose cells have equal mass: RemeshMethod::transport.
#pragma once

#include <powercell/device.hpp>

#include "lib/applications/remeshing/progress.hpp"
#include "lib/applications/remeshing/sampling.hpp"

namespace powercell::remeshing {

/// Repeatedly moves the free seeds to the centroids of cells of equal mass for the density h^-2, projected to
/// the surface, until they move by less than 0.03 h on average. TransportSolver finds the cells. Seeds on
/// kept curves stay; the mass of their cells is proportional to the angle of the surface around them.
/// \param rounds  at most
/// \return the places of the free seeds
/// \throw Error not_converged, interrupted; as TransportSolver
std::vector<Place> equalise_masses(const Sampling& sampling, const Sizing& sizing, const Device& device,
                                   int rounds, Progress progress = {});

}  // namespace powercell::remeshing
