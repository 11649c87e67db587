/// \file
/// The cells of a piece in a file.
#pragma once

#include <array>
#include <cstdint>
#include <powercell/results.hpp>
#include <span>
#include <string>
#include <vector>

#include "lib/base/background.hpp"
#include "lib/exchange/shard.hpp"
#include "lib/out_of_core/files.hpp"
#include "lib/out_of_core/store.hpp"

namespace powercell::out_of_core {

/// The cells of a piece in memory.
struct PieceCells {
  std::vector<std::uint64_t> id;       ///< by rank
  std::vector<std::uint32_t> order;    ///< the cells by ascending id
  exchange::ShardCells cells;          ///< by rank; neighbours and walls may have been left out
  std::vector<std::uint64_t> foreign;  ///< seeds of other pieces with a wall with one of these
};

/// Sets `id`, puts ids in the place of the ranks of neighbours and foreign seeds, and sorts each row of walls
/// by them.
/// \param number  of the piece in the store
void name_by_ids(PieceCells& piece, const Store& store, std::size_t number, int threads);

/// Writes files of pieces in the order of ids, each as a whole or not at all, while the caller goes on.
class PieceWriter {
 public:
  /// Waits for the file before.
  /// \throw Error write_failed (of that one)
  void write(std::string path, PieceCells&& piece);
  /// Waits for the last file.
  /// \throw Error write_failed
  void finish() { last_.finish(); }
  std::uint64_t bytes() const { return bytes_; }  ///< of all files, after finish()

 private:
  std::uint64_t bytes_ = 0;
  BackgroundTask last_;
};

/// What a PieceWriter has written.
class PieceFile {
 public:
  PieceFile() = default;
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
  std::span<const double> wall;  ///< cell by cell; may have been left out, as neighbours
  std::span<const std::uint32_t> neighbor;
  std::span<const Shift> shift;  ///< in a periodic domain

 private:
  MappedFile file_;
};

}  // namespace powercell::out_of_core
