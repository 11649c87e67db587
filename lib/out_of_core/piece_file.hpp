/// \file
/// The cells of a piece in a file. Internal.
#pragma once

#include <array>
#include <cstdint>
#include <powercell/results.hpp>
#include <span>
#include <string>
#include <vector>

#include "lib/exchange/shard.hpp"
#include "lib/out_of_core/files.hpp"

namespace powercell::out_of_core {

/// Writes the file as a whole or not at all. \param ids  ascending
/// \param foreign  ids of seeds of other pieces with a wall with one of these
/// \param walls  whether to write neighbours and walls  \return bytes written
std::uint64_t write_piece(const std::string& path, std::span<const std::uint64_t> ids,
                          const exchange::ShardCells& cells, const std::vector<std::uint64_t>& foreign,
                          bool walls);

/// What write_piece() has written.
class PieceFile {
 public:
  /// \throw Error invalid_file
  PieceFile(const std::string& path, int dimension);

  std::size_t size() const { return id.size(); }
  std::uint64_t bytes() const { return file_.bytes(); }
  void drop() const { file_.drop(); }

  std::span<const std::uint64_t> id;  ///< ascending
  std::span<const double> mass, centroid, second_moment;
  std::span<const std::uint32_t> walls;  ///< of each cell: their number
  std::uint64_t all_walls = 0;           ///< the sum of these
  std::span<const SeedStatus> status;
  std::span<const std::uint64_t> foreign;
  std::span<const std::uint64_t> neighbor;  ///< cell by cell; may have been left out
  std::span<const double> wall;

 private:
  MappedFile file_;
};

}  // namespace powercell::out_of_core
