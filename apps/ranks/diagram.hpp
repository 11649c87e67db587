/// \file
/// powercell_mpi diagram: a diagram of seeds that several processes share.
#pragma once

#include "apps/common.hpp"
#include "apps/ranks/ranks.hpp"

namespace powercell::app {

/// \param ranks  kept by reference
Command add_diagram_of_ranks(CLI::App& app, Ranks& ranks);

}  // namespace powercell::app
