#include "lib/out_of_core/piece_file.hpp"

#include <limits>
#include <utility>

namespace powercell::out_of_core {
namespace {

static_assert(most_seeds_of_diagram <= std::numeric_limits<std::uint32_t>::max(),
              "files have 32 bits of neighbours");

/// Numbers at the head of a file: of cells, of foreign neighbours, of walls, of those that are written, of
/// their shifts.
using Counts = std::array<std::uint64_t, 5>;

/// \return bytes written
std::uint64_t write_file(const std::string& path, const PieceCells& piece) {
  const exchange::ShardCells& cells = piece.cells;
  const Measures& measures = cells.measures;
  std::vector<std::uint32_t> count(piece.id.size());
  for (std::size_t i = 0; i < count.size(); ++i)
    count[i] = static_cast<std::uint32_t>(cells.offset[i + 1] - cells.offset[i]);
  FileWriter file(path, FileWriter::Kind::kept);
  // Longer numbers come first, so that all are where their type may be.
  file.write_all(Counts{piece.id.size(), piece.foreign.size(), cells.offset.back(), cells.neighbor.size(),
                        cells.shift.size()});
  file.write_all(piece.id);
  file.write_all(measures.mass);
  file.write_all(measures.centroid);
  file.write_all(measures.second_moment);
  file.write_all(piece.foreign);
  file.write_all(cells.wall);
  file.write_all(std::vector<std::uint32_t>(cells.neighbor.begin(), cells.neighbor.end()));
  file.write_all(cells.shift);
  file.write_all(count);
  file.write_all(measures.status);
  file.close();
  return file.bytes();
}

}  // namespace

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
