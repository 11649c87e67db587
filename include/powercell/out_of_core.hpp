/// \file
/// Power diagrams of more seeds than memory holds: piece after piece, in files.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <powercell/device.hpp>
#include <powercell/domain.hpp>
#include <powercell/options.hpp>
#include <powercell/results.hpp>
#include <span>
#include <string>
#include <vector>

namespace powercell {

/// Seeds that are elsewhere.
struct SeedSource {
  std::uint64_t count = 0;
  int dimension = 0;  ///< 2 or 3
  /// Names these seeds apart from others, for a computation that goes on after it was stopped: a path, a size
  /// and a time of change, say. Never empty.
  std::string name;
  /// Reads the seeds first, first + 1, ...: as many as there are `weights`, with a row of coordinates of each
  /// in `positions`. Called in ascending order, twice for each seed when it begins and, where there was
  /// something to go on with, not at all; from other threads than the caller's, one at a time. What it throws
  /// ends the computation.
  std::function<void(std::uint64_t first, std::span<double> positions, std::span<double> weights)> read;
};

/// The cells of some consecutive seeds.
struct CellRows {
  std::uint64_t first = 0;  ///< index of the first seed
  Measures measures;        ///< of these cells alone; `domain_measure` is that of the whole domain
  /// Rows + 1: the cell of row i has offset[i+1] - offset[i] walls, also where they are left out.
  std::vector<std::uint64_t> offset;
  /// Indices of seeds, ascending within a row (OutOfCoreOptions::walls).
  std::vector<std::uint64_t> neighbor;
  std::vector<double> wall;  ///< length (polygon) or area (volume), as seen from the cell of the row
  std::vector<std::array<std::int32_t, 3>> shift;  ///< in a periodic domain: as in Adjacency; else empty
  std::uint64_t all_walls = 0;  ///< of all cells, those of other rows too: the sum of their numbers
};

struct OutOfCoreOptions {
  Options diagram;
  /// A folder that is made for what is finished so far and removed at the end; it needs some 100 bytes for
  /// each seed, and 12 more for each side of a wall. Where it is there already, with pieces of the same
  /// computation, that is gone on with. Nothing else may be in it.
  std::string folder;
  /// Bytes that the call may take, with the programs of the device, beside what the process takes before. The
  /// pieces follow from it.
  std::uint64_t memory = std::uint64_t{4} << 30;
  bool walls = false;             ///< give neighbours and walls too
  std::uint64_t piece_seeds = 0;  ///< most seeds of a piece, as far as memory allows; 0 for 2^22
};

/// What a computation came to, and what it took; where it has gone on, `kept` pieces of those before it.
struct OutOfCoreReport {
  std::uint64_t cells = 0, hidden = 0, duplicate = 0;
  double measure = 0, domain_measure = 0;  ///< sum of the masses, compensated; of the domain
  std::uint64_t pieces = 0;
  std::uint64_t kept = 0;                    ///< pieces that an earlier run had finished
  std::uint64_t again = 0;                   ///< pieces computed twice, for flat cells of other pieces
  std::uint64_t rounds = 0;                  ///< of all pieces
  std::uint64_t fetched = 0;                 ///< seeds read for the cells of another piece, once for each
  std::uint64_t neighbors = 0;               ///< of these, with a wall in the end
  std::uint64_t clipped = 0;                 ///< cells, counted each time
  std::uint64_t bytes_read = 0;              ///< seeds and results, from the source and from the folder
  std::uint64_t bytes_written = 0;           ///< to the folder
  double sort = 0, compute = 0, gather = 0;  ///< seconds
};

/// Computes the cells of all seeds in the domain and gives them to `take`, ascending, some at a time; those
/// of no seeds are not given. `take` may keep what it gets. Neighbours and statuses are those of one Diagram
/// of all seeds, measures and walls differ from its by rounding. While `take` is called for the last time all
/// of the folder is there yet: what it throws, or what ends the process, loses no piece. The same call gives
/// the same bits again, however often it was stopped.
/// \throw Error invalid_argument (the source; memory that is too little, with the least that is enough; a
///        folder of another computation, with what differs), invalid_seed (the first one, by its index),
///        write_failed (the folder: disk full and the like), unsupported (surfaces, solids;
///        single precision; fast decisions; Options::certify), interrupted, and as Diagram
POWERCELL_API OutOfCoreReport compute_out_of_core(const Device& device, const Domain& domain,
                                                  const SeedSource& source,
                                                  const std::function<void(CellRows)>& take,
                                                  const OutOfCoreOptions& options);

}  // namespace powercell
