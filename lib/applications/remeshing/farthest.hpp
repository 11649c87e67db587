/// \file
/// Farthest-point optimisation (Yan, Guo, Zhang, Wonka 2014; Schlömer, Heck, Deussen 2011).
#pragma once

#include <vector>

#include "lib/applications/remeshing/progress.hpp"
#include "lib/applications/remeshing/sampling.hpp"

namespace powercell::remeshing {

/// Adds free seeds, each at the farthest vertex of the current cells, until there are `count` seeds.
/// \throw Error invalid_argument if there is no room for more; interrupted
void fill_farthest(Sampling& sampling, std::size_t count, Progress progress = {});

/// Removes each free seed, in random order, and reinserts it at the farthest vertex. Repeats this until the
/// least spacing no longer increases.
/// \param rounds  at most
/// \return after each round the least spacing in units of h
/// \throw Error interrupted
std::vector<double> optimise_farthest(Sampling& sampling, int rounds, Progress progress = {});

}  // namespace powercell::remeshing
