/// \file
/// Notes on points that parts of the domain have too few of.
#pragma once

#include <string>
#include <vector>

#include "apps/sampling/study.hpp"

namespace powercell::app {

/// Of the run with the largest share of parts apart: its layers, or its parts if they are more than 1 % of
/// the domain. One note or none.
std::vector<std::string> notes_of(const Domain& domain, const Study& study, SamplingMode mode);

}  // namespace powercell::app
