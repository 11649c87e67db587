/// \file
#pragma once

#include <powercell/results.hpp>

namespace powercell::test {

/// The cells with vertices within 1e-9 of each other merged, without the faces between pieces.
JoinedCells join_pieces(const Cells& cells);

}  // namespace powercell::test
