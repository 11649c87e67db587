/// \file
/// Farthest-point optimisation (Yan, Guo, Zhang, Wonka 2014; Schlömer, Heck, Deussen 2011).
#pragma once

#include <functional>
#include <vector>

#include "lib/remeshing/sampling.hpp"

namespace powercell::remeshing {

/// Adds free seeds, each at the farthest vertex of the cells there are, until there are `count` in all.
/// \param progress  called with 0, as nothing is done yet; false stops with Error interrupted
void fill_farthest(Sampling& sampling, std::size_t count, const std::function<bool(double)>& progress);

/// Moves each free seed, in random order, to the farthest vertex that its removal leaves; at most `rounds`
/// times, until the least spacing rests. Returns the least spacing over h after each round.
/// \param progress  called with the share of the rounds done, at least once a round; as above
std::vector<double> optimise_farthest(Sampling& sampling, int rounds,
                                      const std::function<bool(double)>& progress);

}  // namespace powercell::remeshing
