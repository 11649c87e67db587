/// \file
/// The argument of --density.
#pragma once

#include <powercell/density.hpp>
#include <string>

namespace powercell::io {

/// \param spec  a number; a file of one value for each vertex of a surface or volume (.txt, .csv); else a
///   formula in x, y and z
/// \throw Error invalid_file, invalid_argument (as Density)
Density read_density(const std::string& spec, const Domain& domain);

}  // namespace powercell::io
