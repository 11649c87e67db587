#include "apps/ranks/rows.hpp"

#include <algorithm>
#include <powercell/out_of_core.hpp>

namespace powercell::app {
namespace {

constexpr std::uint64_t rows_at_once = std::uint64_t{1} << 16;

template <class T>
std::vector<T> part(const std::vector<T>& values, std::uint64_t begin, std::uint64_t end) {
  return {values.begin() + static_cast<std::ptrdiff_t>(begin),
          values.begin() + static_cast<std::ptrdiff_t>(end)};
}

/// \param begin, end rows of `own`
/// \param first  of the rank
CellRows rows_from(const DistributedCells& own, std::uint64_t first, std::uint64_t begin, std::uint64_t end) {
  const auto d = static_cast<std::uint64_t>(own.measures.dimension);
  CellRows rows;
  rows.first = first + begin;
  rows.measures.dimension = own.measures.dimension;
  rows.measures.domain_measure = own.measures.domain_measure;
  rows.measures.mass = part(own.measures.mass, begin, end);
  rows.measures.centroid = part(own.measures.centroid, begin * d, end * d);
  rows.measures.second_moment = part(own.measures.second_moment, begin, end);
  rows.measures.status = part(own.measures.status, begin, end);
  rows.offset = part(own.offset, begin, end + 1);
  rows.neighbor = part(own.neighbor, own.offset[begin], own.offset[end]);
  rows.wall = part(own.wall, own.offset[begin], own.offset[end]);
  if (!own.shift.empty()) rows.shift = part(own.shift, own.offset[begin], own.offset[end]);
  return rows;
}

void send(const Ranks& ranks, const CellRows& rows) {
  ranks.send_to_first(rows.measures.mass);
  ranks.send_to_first(rows.measures.centroid);
  ranks.send_to_first(rows.measures.second_moment);
  ranks.send_to_first(rows.measures.status);
  ranks.send_to_first(rows.offset);
  ranks.send_to_first(rows.neighbor);
  ranks.send_to_first(rows.wall);
  ranks.send_to_first(rows.shift);
}

/// \param from  the rank
/// \param rows  receives all but what is the same on all ranks
void receive(const Ranks& ranks, int from, CellRows& rows) {
  ranks.receive(from, rows.measures.mass);
  ranks.receive(from, rows.measures.centroid);
  ranks.receive(from, rows.measures.second_moment);
  ranks.receive(from, rows.measures.status);
  ranks.receive(from, rows.offset);
  ranks.receive(from, rows.neighbor);
  ranks.receive(from, rows.wall);
  ranks.receive(from, rows.shift);
}

}  // namespace

RowRange rows_of_rank(std::uint64_t rows, int rank, int ranks) {
  const auto r = static_cast<std::uint64_t>(rank), p = static_cast<std::uint64_t>(ranks);
  const auto before = [&](std::uint64_t k) { return rows / p * k + rows % p * k / p; };
  return {before(r), before(r + 1)};
}

void write_rows(Ranks& ranks, const DistributedCells& own, std::uint64_t rows, CellFiles& files) {
  const std::uint64_t walls = ranks.sum(std::uint64_t{own.neighbor.size()});
  if (rows == 0 && ranks.is_first()) files.take_none(own.measures.domain_measure);
  for (int from = 0; from < ranks.size(); ++from) {
    const RowRange range = rows_of_rank(rows, from, ranks.size());
    for (std::uint64_t begin = range.begin; begin < range.end; begin += rows_at_once) {
      const std::uint64_t end = std::min(range.end, begin + rows_at_once);
      // The first rank may fail to write what it got; then nobody waits to send more.
      ranks.together([&] {
        CellRows piece;
        if (ranks.rank() == from) piece = rows_from(own, range.begin, begin - range.begin, end - range.begin);
        if (from > 0 && ranks.rank() == from) send(ranks, piece);
        if (!ranks.is_first()) return;
        if (from > 0) {
          receive(ranks, from, piece);
          piece.first = begin;
          piece.measures.dimension = own.measures.dimension;
          piece.measures.domain_measure = own.measures.domain_measure;
        }
        piece.all_walls = walls;
        files.take(piece);
      });
    }
  }
}

}  // namespace powercell::app
