/** \file
 * Power diagrams of more seeds than memory holds: piece after piece, in files.
 */
#ifndef POWERCELL_C_OUT_OF_CORE_H
#define POWERCELL_C_OUT_OF_CORE_H

#include <powercell/c/device.h>
#include <powercell/c/domain.h>
#include <powercell/c/options.h>
#include <powercell/c/results.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Reads the seeds first, first + 1, ..., `count` of them. Called in ascending order, twice for each seed
 * when a computation begins and, where there was something to go on with, not at all; from other threads than
 * the caller's, one at a time. A callback of C++ that throws stops the call as its answer 0 does, and its
 * exception is the message.
 * \param positions  count x d, row-major: to be written
 * \param weights    count: 0, which may be left
 * \return 0 to stop the call with PC_INTERRUPTED */
typedef int (*pc_read_seeds)(uint64_t first, size_t count, double* positions, double* weights, void* user);

/** Seeds that are elsewhere. Fill with pc_seed_source_init() first. */
typedef struct pc_seed_source {
  size_t struct_size; /**< set by pc_seed_source_init() */
  uint64_t count;     /**< at most PC_MOST_SEEDS */
  int dimension;      /**< d: that of the domain */
  /** Names these seeds apart from others, for a computation that goes on after it was stopped: a path, a size
   * and a time of change, say. Never NULL or "". */
  const char* name;
  pc_read_seeds read;
  void* user; /**< passed to read */
} pc_seed_source;

/** Sets everything to 0. \param struct_size  sizeof(pc_seed_source) */
POWERCELL_API pc_status pc_seed_source_init(pc_seed_source* source, size_t struct_size);

/** The cells of n consecutive seeds. */
typedef struct pc_cell_rows {
  uint64_t first;              /**< index of the first seed */
  const pc_measures* measures; /**< of these cells alone; `domain_measure` is that of the whole domain */
  /** n + 1: the cell of row i has offset[i+1] - offset[i] walls, also where they are left out. */
  const uint64_t* offset;
  const uint64_t* neighbor; /**< offset[n]: indices of seeds, ascending within a row; NULL if left out */
  const double* wall;       /**< offset[n]: length or area, as seen from the cell of the row; likewise */
  const int32_t* shift;     /**< 3 per entry in a periodic domain, as in pc_adjacency; else NULL; likewise */
  uint64_t all_walls;       /**< of all cells, those of other rows too: the sum of their numbers */
} pc_cell_rows;

/** Takes the cells of some seeds, ascending; `rows` last until it returns. After it stops the call, or throws
 * as a callback of C++, the same call gives all rows again, with no piece computed again.
 * \return 0 to stop the call with PC_INTERRUPTED */
typedef int (*pc_take_cells)(const pc_cell_rows* rows, void* user);

/** Options of pc_compute_out_of_core(). Fill with pc_out_of_core_options_init() first. */
typedef struct pc_out_of_core_options {
  size_t struct_size;        /**< set by pc_out_of_core_options_init() */
  const pc_options* diagram; /**< NULL for the defaults */
  /** A folder that is made for what is finished so far and removed at the end; it needs some 100 bytes for
   * each seed, and 12 more for each side of a wall. Where it is there already, with pieces of the same
   * computation, that is gone on with. Nothing else may be in it. Must be set. */
  const char* folder;
  uint64_t memory; /**< bytes that the call may take beside what the process takes before; default 2^32 */
  int walls;       /**< not 0: give neighbours and walls too */
  uint64_t piece_seeds; /**< most seeds of a piece, as far as memory allows; 0, the default, for 2^22 */
} pc_out_of_core_options;

/** Sets every option to its default. \param struct_size  sizeof(pc_out_of_core_options) */
POWERCELL_API pc_status pc_out_of_core_options_init(pc_out_of_core_options* options, size_t struct_size);

/** What a computation came to, and what it took; where it has gone on, `kept` pieces of those before it. */
typedef struct pc_out_of_core_report {
  uint64_t cells, hidden, duplicate; /**< seeds of each pc_seed_status */
  double measure;                    /**< sum of the masses, compensated */
  double domain_measure;
  uint64_t pieces;
  uint64_t kept;                /**< pieces that an earlier run had finished */
  uint64_t again;               /**< pieces computed twice, for flat cells of other pieces */
  uint64_t rounds;              /**< of all pieces */
  uint64_t fetched;             /**< seeds read for the cells of another piece, once for each */
  uint64_t neighbors;           /**< of these, with a wall in the end */
  uint64_t clipped;             /**< cells, counted each time */
  uint64_t bytes_read;          /**< seeds and results, from the source and from the folder */
  uint64_t bytes_written;       /**< to the folder */
  double sort, compute, gather; /**< seconds */
} pc_out_of_core_report;

/** Computes the cells of all seeds in the domain and gives them to `take`, ascending, some at a time; those
 * of no seeds are not given. Neighbours and statuses are those of one diagram of all seeds, measures and
 * walls differ from its by rounding. The same call gives the same bits again, however often it was stopped.
 * PC_INVALID_ARGUMENT: memory that is too little (with the least that is enough), a folder of another
 * computation (with what differs). PC_INVALID_SEED: the first one, by its index. PC_WRITE_FAILED: disk full
 * and the like. PC_UNSUPPORTED: surfaces, solids, single precision, fast decisions, certify.
 * \param user  passed to take */
POWERCELL_API pc_status pc_compute_out_of_core(const pc_device* device, const pc_domain* domain,
                                               const pc_seed_source* source, pc_take_cells take, void* user,
                                               const pc_out_of_core_options* options,
                                               const pc_out_of_core_report** report);
POWERCELL_API void pc_out_of_core_report_destroy(const pc_out_of_core_report* report);

#ifdef __cplusplus
}
#endif
#endif
