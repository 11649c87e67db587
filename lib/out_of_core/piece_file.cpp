#include "lib/out_of_core/piece_file.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "lib/base/threads.hpp"

namespace powercell::out_of_core {
namespace {

static_assert(most_seeds_of_diagram <= std::numeric_limits<std::uint32_t>::max(),
              "files have 32 bits of neighbours");

/// Numbers at the head of a file: of cells, of foreign neighbours, of walls, of those that are written, of
/// their shifts.
using Counts = std::array<std::uint64_t, 5>;

/// Numbers that are put in order at a time.
constexpr std::size_t at_once = std::size_t{1} << 16;

/// Writes `width` numbers of each cell of `order`.
template <class T>
void write_cells(FileWriter& file, std::span<const std::uint32_t> order, const std::vector<T>& numbers,
                 std::size_t width = 1) {
  std::vector<T> block;
  block.reserve(at_once + width);
  for (const std::uint32_t cell : order) {
    const auto from = numbers.begin() + static_cast<std::ptrdiff_t>(cell * width);
    block.insert(block.end(), from, from + static_cast<std::ptrdiff_t>(width));
    if (block.size() < at_once) continue;
    file.write_all(block);
    block.clear();
  }
  file.write_all(block);
}

/// Writes the row of each cell of `order`, as numbers of type To; nothing where no row is listed.
template <class To, class T>
void write_rows(FileWriter& file, std::span<const std::uint32_t> order, std::span<const std::uint64_t> offset,
                const std::vector<T>& numbers) {
  if (numbers.empty()) return;
  std::vector<To> block;
  for (const std::uint32_t cell : order) {
    block.insert(block.end(), numbers.begin() + static_cast<std::ptrdiff_t>(offset[cell]),
                 numbers.begin() + static_cast<std::ptrdiff_t>(offset[cell + 1]));
    if (block.size() < at_once) continue;
    file.write_all(block);
    block.clear();
  }
  file.write_all(block);
}

/// \return bytes written
std::uint64_t write_file(const std::string& path, const PieceCells& piece) {
  const exchange::ShardCells& cells = piece.cells;
  const Measures& measures = cells.measures;
  const std::vector<std::uint32_t>& order = piece.order;
  std::vector<std::uint32_t> count(order.size());
  for (std::size_t i = 0; i < count.size(); ++i)
    count[i] = static_cast<std::uint32_t>(cells.offset[i + 1] - cells.offset[i]);
  FileWriter file(path, FileWriter::Kind::kept);
  // Longer numbers come first, so that all are where their type may be.
  file.write_all(Counts{order.size(), piece.foreign.size(), cells.offset.back(), cells.neighbor.size(),
                        cells.shift.size()});
  write_cells(file, order, piece.id);
  write_cells(file, order, measures.mass);
  write_cells(file, order, measures.centroid, static_cast<std::size_t>(measures.dimension));
  write_cells(file, order, measures.second_moment);
  file.write_all(piece.foreign);
  write_rows<double>(file, order, cells.offset, cells.wall);
  write_rows<std::uint32_t>(file, order, cells.offset, cells.neighbor);
  write_rows<Shift>(file, order, cells.offset, cells.shift);
  write_cells(file, order, count);
  write_cells(file, order, measures.status);
  file.close();
  return file.bytes();
}

/// A wall of a row.
struct Entry {
  std::uint64_t neighbor;
  double wall;
  Shift shift;
};

/// Images of one neighbour keep their order.
void sort_row(exchange::ShardCells& cells, std::size_t cell, std::vector<Entry>& row) {
  const std::uint64_t first = cells.offset[cell], count = cells.offset[cell + 1] - first;
  const bool shifted = !cells.shift.empty();
  row.resize(count);
  for (std::size_t k = 0; k < count; ++k)
    row[k] = {cells.neighbor[first + k], cells.wall[first + k], shifted ? cells.shift[first + k] : Shift{}};
  std::stable_sort(row.begin(), row.end(),
                   [](const Entry& a, const Entry& b) { return a.neighbor < b.neighbor; });
  for (std::size_t k = 0; k < count; ++k) {
    cells.neighbor[first + k] = row[k].neighbor;
    cells.wall[first + k] = row[k].wall;
    if (shifted) cells.shift[first + k] = row[k].shift;
  }
}

}  // namespace

void name_by_ids(PieceCells& piece, const Store& store, std::size_t number, int threads) {
  const std::span<const std::uint64_t> ids = store.ids_of(number);
  piece.id.assign(ids.begin(), ids.end());
  for (std::uint64_t& seed : piece.foreign) seed = store.id(seed);
  exchange::ShardCells& cells = piece.cells;
  if (cells.neighbor.empty()) return;
  parallel_for(threads_for(ids.size(), threads), ids.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<Entry> row;
    for (std::size_t cell = begin; cell < end; ++cell) {
      for (std::uint64_t k = cells.offset[cell]; k < cells.offset[cell + 1]; ++k)
        cells.neighbor[k] = store.id(cells.neighbor[k]);
      sort_row(cells, cell, row);
    }
  });
}

void PieceWriter::write(std::string path, PieceCells&& piece) {
  last_.run([this, path = std::move(path), piece = std::move(piece)] { bytes_ += write_file(path, piece); });
}

PieceFile::PieceFile(const std::string& path, int dimension) : file_(path) {
  std::size_t at = 0;
  const auto take = [&]<class T>(std::span<const T>& to, std::size_t count) {
    to = file_.numbers<T>(at, count);
    at += to.size_bytes();
  };
  std::span<const std::uint64_t> counts;
  take(counts, std::tuple_size_v<Counts>);
  const std::size_t cells = counts[0];
  take(id, cells);
  take(mass, cells);
  take(centroid, cells * static_cast<std::size_t>(dimension));
  take(second_moment, cells);
  take(foreign, counts[1]);
  all_walls = counts[2];
  take(wall, counts[3]);
  take(neighbor, counts[3]);
  take(shift, counts[4]);
  take(walls, cells);
  take(status, cells);
}

}  // namespace powercell::out_of_core
