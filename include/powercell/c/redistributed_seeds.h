/** \file
 * Seeds of several ranks, shared out anew so that those of a rank are near each other.
 */
#ifndef POWERCELL_C_REDISTRIBUTED_SEEDS_H
#define POWERCELL_C_REDISTRIBUTED_SEEDS_H

#include <powercell/c/distributed.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Seeds on the ranks that compute with them: each has about as many, a range of a Hilbert curve through all.
 * For programs that have no division of space of their own, such as those that read seeds from a file.
 * pc_distributed_options.redistribute does the same for one call. */
typedef struct pc_redistributed_seeds {
  size_t count;            /**< n: seeds that are on this rank now */
  int dimension;           /**< d */
  const uint64_t* ids;     /**< n */
  const double* positions; /**< n x d, row-major, as given */
  const double* weights;   /**< n, also where none were given */
} pc_redistributed_seeds;

/** Sends the seeds. All ranks call it, those without seeds too. Errors reach all ranks, as of
 * pc_compute_distributed().
 * PC_INVALID_ARGUMENT: dimensions. PC_INVALID_SEED: a position that is not finite.
 * \param communicator  its `user` must last as long as the result
 * \param dimension     d: 2 or 3, the same on all ranks, also where there are no seeds
 * \param ids           count, each once on all ranks (which is not checked here)
 * \param positions     count x d, row-major, unit length
 * \param weights       count, unit length^2; NULL means all zero
 * \param domain        that they are for: seeds are near each other as wrapped into it, if it is periodic;
 *                      NULL for as given */
POWERCELL_API pc_status pc_redistributed_seeds_create(const pc_communicator* communicator, int dimension,
                                                      const uint64_t* ids, const double* positions,
                                                      const double* weights, size_t count,
                                                      const pc_domain* domain,
                                                      const pc_redistributed_seeds** seeds);

/** Sends cells back to the ranks that gave their seeds. All ranks call it, on which errors are the same but
 * for `seeds` that are NULL. PC_INVALID_ARGUMENT: cells of more or fewer seeds.
 * \param cells  of these seeds, in their order, as the library made them
 * \param back   those of the seeds that this rank gave, in its order, with the report of `cells`; to be freed
 *               by pc_distributed_cells_destroy() */
POWERCELL_API pc_status pc_redistributed_seeds_send_back(const pc_redistributed_seeds* seeds,
                                                         const pc_distributed_cells* cells,
                                                         const pc_distributed_cells** back);
POWERCELL_API void pc_redistributed_seeds_destroy(const pc_redistributed_seeds* seeds);

#ifdef __cplusplus
}
#endif
#endif
