/// \file
#pragma once

#include <powercell/results.hpp>

namespace powercell::test {

/// Cells whose vertices within 1e-9 of each other are one, without the faces between pieces.
JoinedCells join_pieces(const Cells& cells);

}  // namespace powercell::test
