/// \file
/// The colours of a diagram's cells.
#pragma once

#include "apps/io/picture/colouring.hpp"
#include "apps/io/write/output.hpp"

namespace powercell::io {

/// By the style of `output`: hues that tell neighbours apart (cell_colours), or values with a legend. The
/// legend is empty if colours mean nothing, or the style wants none.
Colouring colouring_of(const DiagramOutput& output);

/// Flat pictures of more seeds do not mark them: they could not be told apart.
constexpr std::size_t most_discs = 20'000;

}  // namespace powercell::io
