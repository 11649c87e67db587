/// \file
/// Clipped pieces, read back from a launch or made on the host.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lib/scene/variant.hpp"

namespace powercell {

/// The rows of one launch (kernels/clip/write.cl), packed or mapped from the device, in device units, with
/// coordinates relative to the seed. Row r has the faces [face_offset[r], face_offset[r+1]): all of them with
/// OUTPUT_GEOMETRY, else the walls only.
struct PieceBatch {
  std::vector<std::uint32_t> face_offset;       ///< rows + 1
  std::vector<std::int32_t> border;             ///< per face: rank, or ~facet slot of the region
  std::vector<double> wall;                     ///< per face: its measure
  std::vector<std::uint32_t> vertex_offset;     ///< rows + 1
  std::vector<double> vertex;                   ///< dimension per vertex
  std::vector<std::uint32_t> link;              ///< 6 per vertex (polyhedra)
  const std::int32_t* mapped_border = nullptr;  ///< if not null, the borders, rows `stride` entries apart
  const double* mapped_wall = nullptr;
  std::size_t stride = 0;
  /// A row may contain a seed more than once: if it was made of several pieces, or if decisions were left to
  /// rounding, where a bisector may touch several faces.
  bool repeats = false;

  /// Removes all rows; keeps the memory.
  void clear() {
    face_offset.clear();
    border.clear();
    wall.clear();
    vertex_offset.clear();
    vertex.clear();
    link.clear();
    mapped_border = nullptr;
    mapped_wall = nullptr;
    repeats = false;
  }
  /// Whether a row contains a seed more than once.
  bool row_repeats(std::size_t row) const;
  /// Copies mapped rows into the vectors.
  void copy_mapped();
  const std::int32_t* borders(std::size_t row) const {
    return mapped_border ? mapped_border + row * stride : border.data() + face_offset[row];
  }
  const double* walls(std::size_t row) const {
    return mapped_border ? mapped_wall + row * stride : wall.data() + face_offset[row];
  }
  std::uint32_t faces(std::size_t row) const { return face_offset[row + 1] - face_offset[row]; }
  std::uint32_t vertices(std::size_t row) const { return vertex_offset[row + 1] - vertex_offset[row]; }
};

/// The pieces of a chunk of pairs.
struct PieceSet {
  std::vector<std::uint32_t> status;  ///< per pair: PIECE_DONE, _EMPTY or _FLAT
  std::vector<std::uint32_t> batch;   ///< per pair: its batch
  std::vector<std::uint32_t> row;     ///< per pair: its row in the batch
  std::vector<double>
      reach;  ///< per pair, with OUTPUT_REACH: of its farthest vertex from the seed; else empty
  std::vector<std::uint32_t> tied;  ///< pairs, ascending, in which infinitesimals (86) decided
  std::vector<PieceBatch> batches;  ///< those in use come first
  std::size_t used = 0;             ///< number of batches in use; the others keep their memory

  PieceBatch& add_batch() {
    if (used == batches.size()) batches.emplace_back();
    return batches[used++];
  }
};

}  // namespace powercell
