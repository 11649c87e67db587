/// \file
/// Clipped pieces as they come back from a launch.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lib/clip/variant.hpp"

namespace powercell {

/// Rows of one launch (kernels/clip/write.cl), device units, coordinates relative to the seed.
struct PieceBatch {
  Capacity capacity{};
  std::vector<std::uint32_t> faces;     ///< rows: number of faces
  std::vector<std::int32_t> border;     ///< rows x capacity.faces: rank, or ~facet slot of the region
  std::vector<double> wall;             ///< rows x capacity.faces: measure of each face
  std::vector<std::uint32_t> vertices;  ///< rows: number of vertices
  std::vector<double> vertex;           ///< rows x capacity.vertices x dimension
  std::vector<std::uint32_t> link;      ///< rows x capacity.vertices x 6 (polyhedra)
};

/// The pieces of a chunk of pairs.
struct PieceSet {
  std::vector<std::uint32_t> status;  ///< per pair: PIECE_WHOLE, _EMPTY or _FLAT
  std::vector<std::uint32_t> batch;   ///< per pair: which batch
  std::vector<std::uint32_t> row;     ///< per pair: which row of it
  std::vector<PieceBatch> batches;
};

}  // namespace powercell
