/// \file
/// Unstructured grids in pieces, as VTK's parallel files have them.
#pragma once

#include <cstdint>
#include <powercell/diagram.hpp>
#include <string>
#include <vector>

namespace powercell::io {

/// The cells of one of several processes.
struct VtuPiece {
  int number;
  Diagram& diagram;                        ///< computes what it has not yet
  std::vector<std::uint32_t> seeds;        ///< its selection
  std::vector<std::uint64_t> ids;          ///< of these
  std::vector<double> positions, weights;  ///< of these
};

/// Writes NAME/NAME_K.vtu for NAME.pvtu and piece K, as write_output() does, but with ids as seeds.
/// \throw Error write_failed
void write_vtu_piece(const std::string& path, const VtuPiece& piece);

/// Writes the file that names all pieces.
/// \throw Error write_failed
void write_pvtu(const std::string& path, int pieces);

}  // namespace powercell::io
