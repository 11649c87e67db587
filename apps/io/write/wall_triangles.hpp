/// \file
/// Triangles of the faces of cells that share them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/io/write/shared_cells.hpp"

namespace powercell::io {

/// The triangles of a polygon in a plane, three points each, in its direction.
/// \param points  rows of 3
/// \param path  for the message
/// \throw Error write_failed (a concave polygon of thousands of corners)
std::vector<std::uint32_t> triangles_of(const std::string& path, const std::vector<double>& points,
                                        std::vector<std::uint32_t> loop);

/// The triangles of face f of a volume's cells, three points each, counter-clockwise seen from outside of the
/// face's own cell. A wall has the same ones from both sides.
/// \throw Error as above
std::vector<std::uint32_t> triangles_of(const std::string& path, const SharedCells& cells, std::uint64_t f);

}  // namespace powercell::io
