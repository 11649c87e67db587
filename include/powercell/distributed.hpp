/// \file
/// Power diagrams whose seeds are on several ranks, none of which has all of them.
#pragma once

#include <array>
#include <cstdint>
#include <powercell/communicator.hpp>
#include <powercell/device.hpp>
#include <powercell/domain.hpp>
#include <powercell/options.hpp>
#include <powercell/results.hpp>
#include <powercell/seeds.hpp>
#include <span>
#include <vector>

namespace powercell {

/// What ranks sent to each other, and what it took, of all ranks together.
struct ExchangeReport {
  int rounds = 0;                   ///< in which some cell was clipped
  std::uint64_t fetched = 0;        ///< seeds sent to other ranks, once for each
  std::uint64_t neighbors = 0;      ///< of these, with a wall in the end
  std::uint64_t clipped = 0;        ///< cells, counted each time
  std::uint64_t vertices = 0;       ///< that other ranks were asked about
  std::uint64_t outlines = 0;       ///< bytes of the upper levels of trees
  std::uint64_t requests = 0;       ///< bytes
  std::uint64_t replies = 0;        ///< bytes
  std::uint64_t ending = 0;         ///< bytes of the messages about hidden seeds
  std::uint64_t redistributed = 0;  ///< bytes of seeds and results (DistributedOptions::redistribute)
};

/// The cells of the n seeds of one rank, in the order in which it gave them.
struct DistributedCells {
  /// Of these cells alone, total() too; `domain_measure` is that of the whole domain. Of duplicates that are
  /// as heavy the one of the lowest id on all ranks has the cell.
  Measures measures;
  /// n + 1: row i of the walls with other cells is [offset[i], offset[i+1]).
  std::vector<std::uint64_t> offset;
  std::vector<std::uint64_t> neighbor;  ///< ids of seeds of any rank, ascending within a row
  std::vector<double> wall;  ///< length (polygon) or area (volume), as seen from the cell of the row
  std::vector<std::array<std::int32_t, 3>> shift;  ///< in a periodic domain: as in Adjacency; else empty
  ExchangeReport report;
};

struct DistributedOptions {
  /// Of the diagrams on this rank. `precision`, `decisions` and `certify` must be the same on all ranks, the
  /// others may differ. `progress` is called with the fraction of what is clipped at present on this rank;
  /// where it returns false, the computation ends on all ranks.
  Options diagram;
  /// Compute on other ranks than those of the callers: each gets about as many seeds, a range of a Hilbert
  /// curve, for the call, and results go back. For seeds that are not near each other on their rank, or few
  /// on some ranks and many on others. The same on all ranks.
  bool redistribute = false;
};

/// Computes the cells of the seeds of all ranks. All ranks must call it, each with its own seeds, with the
/// same domain and on a device of its own or a shared one; ranks without seeds too. Neighbours and statuses
/// are those of one Diagram of all seeds in ascending order of ids, whatever rank has which; measures and
/// walls differ from its by rounding. How seeds are shared out decides how much is sent (docs/scale.md). An
/// error on one rank is thrown on all, and the communicator can be used again; what one rank alone knows
/// begins with its number. An exception of Options::progress is thrown as it is on its own rank.
/// \param ids    of the seeds, each once on all ranks
/// \param seeds  as many, of the domain's dimension also where there are none
/// \throw Error invalid_argument (sizes; an id that is there twice; domains or options that differ between
///        ranks, and in what), invalid_seed (names the seed by its id), unsupported (surfaces and
///        solids; single precision; fast decisions; Options::certify), interrupted, and as Diagram
POWERCELL_API DistributedCells compute_distributed(Communicator& communicator, const Device& device,
                                                   const Domain& domain, std::span<const std::uint64_t> ids,
                                                   const SeedsView& seeds,
                                                   const DistributedOptions& options = {});

}  // namespace powercell
