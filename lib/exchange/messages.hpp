/// \file
/// What shards tell each other: plain arrays of numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lib/base/bytes.hpp"
#include "lib/exchange/boxes.hpp"
#include "lib/seeds/packed_tree.hpp"

namespace powercell::exchange {

/// The part of a shard that seeds of another may concern, with the question for a coarse tree of these.
struct NearPart {
  Box box;
  double lightest = 0;  ///< weight of a seed there
};

/// Leaves of a shard's tree at its boundary, with the question which seeds of another are likely neighbours.
struct BoundaryLeaves {
  std::vector<double> spacing;  ///< per leaf: how far its seeds are apart, about
  /// Per leaf: rows of positions, of eight seeds; some more than once if it has fewer.
  std::vector<double> seed;
  std::uint64_t all = 0;  ///< leaves of the tree
  double lightest = 0;    ///< weight of a seed of these leaves

  std::size_t leaves() const { return spacing.size(); }
  std::size_t bytes() const { return bytes_of(spacing) + bytes_of(seed) + sizeof all + sizeof lightest; }
};

/// Seeds near the boundary of another shard.
struct Halo {
  std::vector<std::uint64_t> id;
  std::vector<double> seed;  ///< rows of position and weight
  PackedTree unsent;         ///< a coarse tree of those that were not sent

  std::size_t bytes() const { return bytes_of(id) + bytes_of(seed); }
};

/// Vertices of cells, with the question which seeds of another shard could cut them off.
struct Request {
  /// Rows of the cells' seeds: position, weight, and the distance of the farthest vertex.
  std::vector<double> cell;
  std::vector<std::uint32_t> end;  ///< per cell: the end of its vertices
  std::vector<float> vertex;       ///< rows of coordinates, from the seed, in units of that distance

  std::size_t cells() const { return end.size(); }
  std::size_t bytes() const { return bytes_of(cell) + bytes_of(end) + bytes_of(vertex); }
};

/// Seeds that cut the cells of a request, or touch them, and that have not been sent before.
struct Reply {
  std::vector<std::uint64_t> id;
  std::vector<double> seed;  ///< rows of position and weight
  /// Per vertex of the request: 1 if a seed sent now could cut it off, 0 if no seed but those sent before
  /// could.
  std::vector<std::uint8_t> found;
  PackedTree coarse_tree;  ///< of all its seeds, if the asker has none yet

  std::size_t bytes() const { return bytes_of(id) + bytes_of(seed) + bytes_of(found); }
};

/// Hidden seeds, with the question which of them are duplicates.
struct Duplicates {
  std::vector<std::uint64_t> id;
  std::vector<double> seed;  ///< rows of position and weight

  std::size_t bytes() const { return bytes_of(id) + bytes_of(seed); }
};

}  // namespace powercell::exchange
