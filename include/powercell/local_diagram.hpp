/// \file
/// The shapes of cells whose seeds are on several ranks.
#pragma once

#include <cstdint>
#include <powercell/communicator.hpp>
#include <powercell/device.hpp>
#include <powercell/diagram.hpp>
#include <powercell/distributed.hpp>
#include <powercell/domain.hpp>
#include <powercell/options.hpp>
#include <powercell/seeds.hpp>
#include <span>
#include <vector>

namespace powercell {

/// A diagram of one rank: what compute_distributed() does not give of its cells.
struct LocalDiagram {
  Diagram diagram;  ///< of the seeds `ids`, of which `cells` are selected (Diagram::select)
  std::vector<std::uint64_t>
      ids;  ///< of the seeds with a cell on this rank and of their neighbours, ascending
  std::vector<std::uint32_t>
      cells;  ///< places in `ids` of the seeds of this rank that have a cell, in its order
};

/// Makes a diagram of the cells of this rank from their neighbours alone, whose positions and weights it gets
/// from the others. All ranks call it, with what they gave to compute_distributed() and what they got.
/// Neighbours are those of `cells`, measures and walls differ from theirs by rounding. Clips the cells once
/// more when results are asked for, which needs no other rank; and at first, all ranks together, in a box
/// around a domain that is not convex, where walls within the domain do not tell all seeds that cells depend
/// on.
/// \param cells  of `seeds`, in their order, on all ranks of one call
/// \param options  of the diagram
/// \throw Error invalid_argument (sizes; a neighbour that no rank has), and as Diagram; one of one rank is
///        thrown on all
POWERCELL_API LocalDiagram local_diagram(Communicator& communicator, const Device& device,
                                         const Domain& domain, std::span<const std::uint64_t> ids,
                                         const SeedsView& seeds, const DistributedCells& cells,
                                         const Options& options = {});

}  // namespace powercell
