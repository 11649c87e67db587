/** \file
 * The laws of a power diagram, checked on a computed one (docs/mathematics.md).
 */
#ifndef POWERCELL_C_VERIFY_H
#define POWERCELL_C_VERIFY_H

#include <powercell/c/diagram.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Options of pc_diagram_verify(). Fill with pc_verify_options_init() first. */
typedef struct pc_verify_options {
  size_t struct_size;   /**< set by pc_verify_options_init() */
  size_t samples;       /**< random points at which all seeds are tried; default 1000 */
  uint64_t random_seed; /**< default 1 */
  pc_progress progress; /**< called after each law; may be NULL */
  void* progress_user;  /**< passed to progress */
} pc_verify_options;

/** Sets every option to its default. \param struct_size  sizeof(pc_verify_options) */
POWERCELL_API pc_status pc_verify_options_init(pc_verify_options* options, size_t struct_size);

/** A diagram without its domain, as the tool saves it. Fill with pc_saved_diagram_init() first. Arrays are
 * the caller's, as in pc_measures and pc_joined_cells. */
typedef struct pc_saved_diagram {
  size_t struct_size; /**< set by pc_saved_diagram_init() */
  pc_domain_kind kind;
  pc_precision precision; /**< in which it was computed: PC_FLOAT64, the default, or PC_FLOAT32 */
  size_t count;           /**< n */
  int dimension;          /**< d */
  int cell_dimension;
  const double* positions; /**< n x d */
  const double* weights;   /**< n; NULL means all zero */
  double domain_measure;
  const double* mass;            /**< n */
  const double* centroid;        /**< n x d; may be NULL */
  const uint8_t* status;         /**< n: a pc_seed_status each */
  const uint64_t* vertex_offset; /**< n + 1 */
  const double* vertices;        /**< vertex_offset[n] x d */
  const uint64_t* face_offset;   /**< n + 1 */
  const uint64_t* loop_offset;   /**< face_offset[n] + 1 */
  const uint32_t* loop;          /**< loop_offset[face_offset[n]] */
  const pc_border* face_border;  /**< per face (volumes only) */
  const pc_border* edge_border;  /**< per loop entry (polygons and surfaces only) */
  const int32_t* shift;          /**< NULL: with the 3 per border of a periodic domain PC_UNSUPPORTED */
} pc_saved_diagram;

/** Sets everything to 0 and the precision to PC_FLOAT64. \param struct_size  sizeof(pc_saved_diagram) */
POWERCELL_API pc_status pc_saved_diagram_init(pc_saved_diagram* diagram, size_t struct_size);

/** One law and how well it holds. */
typedef struct pc_law_check {
  const char* law;    /**< e.g. "partition: the measures sum to the domain's" */
  int passed;         /**< 1 or 0 */
  double value;       /**< the measured defect */
  double tolerance;   /**< the largest defect allowed */
  const char* detail; /**< if not passed: the worst offender, with seed numbers; else "" */
} pc_law_check;

typedef struct pc_law_checks {
  size_t count;
  const pc_law_check* const* checks; /**< count pointers */
  int passed;                        /**< 1 if all laws hold, else 0 */
} pc_law_checks;

/** Checks the laws that need no reference: partition of the measure; statuses; walls equal from both
 * sides and on their bisectors; each cell's measure and centroid from its pieces; random points of the
 * domain in the cell of least power distance, found by trying all seeds. A law that does not hold is
 * not a failure of the call.
 * \param positions  the seeds of the diagram, as given to pc_diagram_set_seeds()
 * \param weights    as given there
 * \param count      as given there
 * \param options    NULL for the defaults */
POWERCELL_API pc_status pc_diagram_verify(pc_diagram* diagram, const double* positions, const double* weights,
                                          size_t count, const pc_verify_options* options,
                                          const pc_law_checks** checks);
/** The same laws from the arrays alone, nothing of which is trusted but their sizes; vertices of the cells
 * take the place of random points. PC_INVALID_ARGUMENT if the arrays do not fit together (which cell). */
POWERCELL_API pc_status pc_saved_diagram_verify(const pc_saved_diagram* diagram,
                                                const pc_verify_options* options,
                                                const pc_law_checks** checks);
POWERCELL_API void pc_law_checks_destroy(const pc_law_checks* checks);

#ifdef __cplusplus
}
#endif
#endif
