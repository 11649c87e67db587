/** \file
 * Power diagrams whose seeds are on several ranks, none of which has all of them.
 */
#ifndef POWERCELL_C_DISTRIBUTED_H
#define POWERCELL_C_DISTRIBUTED_H

#include <powercell/c/communicator.h>
#include <powercell/c/device.h>
#include <powercell/c/domain.h>
#include <powercell/c/options.h>
#include <powercell/c/results.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What ranks sent to each other, and what it took, of all ranks together. */
typedef struct pc_exchange_report {
  uint64_t rounds;        /**< in which some cell was clipped */
  uint64_t fetched;       /**< seeds sent to other ranks, once for each */
  uint64_t neighbors;     /**< of these, with a wall in the end */
  uint64_t clipped;       /**< cells, counted each time */
  uint64_t vertices;      /**< that other ranks were asked about */
  uint64_t outlines;      /**< bytes of the upper levels of trees */
  uint64_t requests;      /**< bytes */
  uint64_t replies;       /**< bytes */
  uint64_t ending;        /**< bytes of the messages about hidden seeds */
  uint64_t redistributed; /**< bytes of seeds and results (pc_distributed_options.redistribute) */
} pc_exchange_report;

/** The cells of the n seeds of one rank, in the order in which it gave them. */
typedef struct pc_distributed_cells {
  size_t count;       /**< n */
  size_t entry_count; /**< offset[n] */
  /** Of these cells alone, `total` too; `domain_measure` is that of the whole domain. Of duplicates that are
   * as heavy the one of the lowest id on all ranks has the cell. */
  const pc_measures* measures;
  const uint64_t* offset;   /**< n + 1: row i of the walls with other cells is [offset[i], offset[i+1]) */
  const uint64_t* neighbor; /**< per entry: ids of seeds of any rank, ascending within a row */
  const double* wall;       /**< per entry: length (polygon) or area (volume), as seen from the row's cell */
  const int32_t* shift;     /**< 3 per entry in a periodic domain, as in pc_adjacency; else NULL */
  const pc_exchange_report* report;
} pc_distributed_cells;

/** Options of pc_compute_distributed(). Fill with pc_distributed_options_init() first. */
typedef struct pc_distributed_options {
  size_t struct_size; /**< set by pc_distributed_options_init() */
  /** Of the diagrams on this rank; NULL for the defaults. `precision`, `decisions` and `certify` must be the
   * same on all ranks, the others may differ. `progress` is called with the fraction of what is clipped at
   * present on this rank; where it answers 0, the computation ends on all ranks.
   */
  const pc_options* diagram;
  /** Not 0: compute on other ranks than those of the callers. Each gets about as many seeds, a range of a
   * Hilbert curve, for the call, and results go back. For seeds that are not near each other on their rank,
   * or few on some ranks and many on others. The same on all ranks. */
  int redistribute;
} pc_distributed_options;

/** Sets every option to its default. \param struct_size  sizeof(pc_distributed_options) */
POWERCELL_API pc_status pc_distributed_options_init(pc_distributed_options* options, size_t struct_size);

/** Computes the cells of the seeds of all ranks. All ranks must call it, each with its own seeds, with the
 * same domain and on a device of its own or a shared one; ranks without seeds too. Neighbours and statuses
 * are those of one diagram of all seeds in ascending order of ids, whatever rank has which; measures and
 * walls differ from its by rounding. How seeds are shared out decides how much is sent (docs/scale.md).
 *
 * An error on one rank, NULL arguments included, ends the call on all with the same message, and the
 * communicator can be used again; what one rank alone knows begins with its number. Told to its own rank
 * alone is what is wrong with the communicator, and memory that is lacking for the results in the end.
 * PC_INVALID_ARGUMENT: an id that is there twice; domains or options that differ between ranks, and in what.
 * PC_INVALID_SEED: names the seed by its id. PC_UNSUPPORTED: surfaces, solids, single precision, fast
 * decisions, certify.
 * \param ids        count, each once on all ranks; NULL if count is 0, as the next two
 * \param positions  count x d, row-major, unit length
 * \param weights    count, unit length^2; NULL means all zero */
POWERCELL_API pc_status pc_compute_distributed(const pc_communicator* communicator, const pc_device* device,
                                               const pc_domain* domain, const uint64_t* ids,
                                               const double* positions, const double* weights, size_t count,
                                               const pc_distributed_options* options,
                                               const pc_distributed_cells** cells);
POWERCELL_API void pc_distributed_cells_destroy(const pc_distributed_cells* cells);

#ifdef __cplusplus
}
#endif
#endif
