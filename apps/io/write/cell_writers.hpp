/// \file
/// Tables of cells and walls that are written as cells come, in ascending order of their seeds.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <powercell/results.hpp>
#include <powercell/seeds.hpp>
#include <span>
#include <string>
#include <vector>

namespace powercell::io {

/// Some of the cells, one seed after the other. Nothing is owned.
struct CellBatch {
  std::uint64_t first = 0;  ///< index of the first seed
  SeedsView seeds;
  const Measures& measures;
  std::span<const std::uint64_t> offset;  ///< rows + 1, from any number on: of the walls
  std::span<const std::uint64_t> neighbor;
  std::span<const double> wall;
  std::span<const std::array<std::int32_t, 3>> shift;  ///< in a periodic domain
};

class CellWriter {
 public:
  CellWriter() = default;
  CellWriter(const CellWriter&) = delete;
  CellWriter& operator=(const CellWriter&) = delete;
  virtual ~CellWriter() = default;
  /// \throw Error write_failed
  virtual void add(const CellBatch& cells) = 0;
  /// \throw Error write_failed
  virtual void commit() = 0;
};

/// By the extension of the path a CSV as write_table() has it, or an array of NumPy of as many rows as there
/// are seeds, with the fields status (0 ok, 1 hidden, 2 duplicate), measure, cx, cy (, cz), second_moment,
/// neighbors.
std::unique_ptr<CellWriter> table_writer(const std::string& path, int dimension, std::uint64_t seeds);

/// A CSV `seed,neighbor,measure`, or for `NAME.npy` compressed sparse rows as SciPy has them in
/// NAME.indptr.npy, NAME.indices.npy and NAME.data.npy. In a periodic domain the CSV has the columns
/// `sx,sy[,sz]` too, and NAME.shift.npy these fields.
/// \param walls  sides of walls in all
/// \param shift_axes  in a periodic domain its dimension, else 0
std::unique_ptr<CellWriter> walls_writer(const std::string& path, std::uint64_t seeds, std::uint64_t walls,
                                         int shift_axes);

/// The files that walls_writer() writes.
std::vector<std::string> walls_files(const std::string& path, int shift_axes);

}  // namespace powercell::io
