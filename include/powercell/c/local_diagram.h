/** \file
 * The shapes of cells whose seeds are on several ranks.
 */
#ifndef POWERCELL_C_LOCAL_DIAGRAM_H
#define POWERCELL_C_LOCAL_DIAGRAM_H

#include <powercell/c/diagram.h>
#include <powercell/c/distributed.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A diagram of one rank: what pc_compute_distributed() does not give of its cells. */
typedef struct pc_local_diagram {
  /** Of the seeds `ids`, of which `cells` are selected (pc_diagram_select). Lasts as long as this;
   * pc_diagram_destroy() does nothing to it. */
  pc_diagram* diagram;
  size_t id_count;
  const uint64_t*
      ids; /**< id_count: of the seeds with a cell on this rank and of their neighbours, ascending */
  size_t cell_count;
  const uint32_t*
      cells; /**< cell_count: places in `ids` of the seeds of this rank that have a cell, in order */
} pc_local_diagram;

/** Makes a diagram of the cells of this rank from their neighbours alone, whose positions and weights it gets
 * from the others. All ranks call it, with what they gave to pc_compute_distributed() and what they got.
 * Neighbours are those of `cells`, measures and walls differ from theirs by rounding. Clips the cells once
 * more when results are asked for, which needs no other rank; and at first, all ranks together, in a box
 * around a domain that is not convex. Errors reach all ranks, as of pc_compute_distributed().
 * PC_INVALID_ARGUMENT: seeds and cells that are not of one call, a neighbour that no rank has.
 * \param cells    of these seeds, in their order, as the library made them; of one call on all ranks
 * \param options  of the diagram; NULL for the defaults */
POWERCELL_API pc_status pc_local_diagram_create(const pc_communicator* communicator, const pc_device* device,
                                                const pc_domain* domain, const uint64_t* ids,
                                                const double* positions, const double* weights, size_t count,
                                                const pc_distributed_cells* cells, const pc_options* options,
                                                const pc_local_diagram** local);
POWERCELL_API void pc_local_diagram_destroy(const pc_local_diagram* local);

#ifdef __cplusplus
}
#endif
#endif
