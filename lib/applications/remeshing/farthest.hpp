/// \file
/// Farthest-point optimisation (Yan, Guo, Zhang, Wonka 2014; Schlömer, Heck, Deussen 2011).
#pragma once

#include <vector>

#include "lib/applications/remeshing/progress.hpp"
#include "lib/applications/remeshing/sampling.hpp"

namespace powercell::remeshing {

/// Adds free seeds, each at the farthest vertex of the cells there are, until there are `count` in all.
/// \throw Error interrupted; invalid_argument: no room
void fill_farthest(Sampling& sampling, std::size_t count, Progress progress = {});

/// Moves each free seed, in random order, to the farthest vertex that its removal leaves; at most `rounds`
/// times, until the least spacing rests. Returns the least spacing over h after each round.
/// \throw Error interrupted
std::vector<double> optimise_farthest(Sampling& sampling, int rounds, Progress progress = {});

}  // namespace powercell::remeshing
