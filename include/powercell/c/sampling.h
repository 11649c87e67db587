/** \file
 * Blue-noise sampling: points whose power cells all have the same mass of a density.
 */
#ifndef POWERCELL_C_SAMPLING_H
#define POWERCELL_C_SAMPLING_H

#include <powercell/c/density.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Purpose of the points. */
typedef enum pc_sampling_mode {
  PC_SAMPLING_BLUE =
      0, /**< even but irregular: stops at a hexatic order in the plane, elsewhere after 20 iterations */
  PC_SAMPLING_QUANTISE /**< lowest energy: the best quantiser of the density */
} pc_sampling_mode;

/** How the points move. */
typedef enum pc_sampling_descent {
  PC_DESCENT_AUTOMATIC = 0, /**< Lloyd for blue noise, else L-BFGS */
  PC_DESCENT_LLOYD,         /**< to the centroids of their cells */
  PC_DESCENT_LBFGS
} pc_sampling_descent;

/** State after one iteration, which moves all points. */
typedef struct pc_sampling_step {
  int iteration;         /**< 0 for the initial points */
  int newton_steps;      /**< of the transport */
  double energy;         /**< sum of the second moments */
  double gradient;       /**< root mean square of |c_i - p_i|, a length */
  double hexatic;        /**< as in pc_spacing(); NaN if not needed */
  double capacity_error; /**< max |m_i / (M/n) - 1| */
  double seconds;        /**< wall-clock time of this iteration, without compiling kernels */
} pc_sampling_step;

/** Receives each step; returns 0 to stop the call with PC_INTERRUPTED. */
typedef int (*pc_sampling_progress)(const pc_sampling_step* step, void* user);

/** Options of a sampling. Fill with pc_sampling_options_init() first. */
typedef struct pc_sampling_options {
  size_t struct_size;        /**< set by pc_sampling_options_init() */
  const pc_density* density; /**< NULL means 1 everywhere */
  const pc_options* diagram; /**< of the diagrams; NULL for the defaults */
  pc_sampling_mode mode;
  pc_sampling_descent descent;
  int periodic;   /**< not 0: a box with its opposite sides identified, short for pc_domain_periodic_box() */
  int iterations; /**< limit; 0 means 100 for blue in the plane, 20 for blue elsewhere, 10,000 for quantise */
  double hexatic; /**< blue in the plane stops at this hexatic order, between 0 and 1; default 0.61 */
  double movement; /**< stops when the gradient is below this fraction of the spacing; default 1e-4 */
  double capacity_tolerance;     /**< limit on max |m_i / (M/n) - 1| in the result; default 1e-6 */
  uint64_t random_seed;          /**< of the initial points; default 1 */
  pc_sampling_progress progress; /**< may be NULL */
  void* progress_user;           /**< passed to progress */
} pc_sampling_options;

/** Sets every option to its default. \param struct_size  sizeof(pc_sampling_options) */
POWERCELL_API pc_status pc_sampling_options_init(pc_sampling_options* options, size_t struct_size);

/** The n points, in the order of the initial points. */
typedef struct pc_sampling_result {
  size_t count;            /**< n */
  int dimension;           /**< d */
  int converged;           /**< 1 or 0 */
  const double* positions; /**< n x d, row-major, in the domain (on a surface: on it) */
  const double* weights;   /**< n, length^2: with them all cells have equal mass */
  const double* mass;      /**< n: masses of the cells */
  double capacity_error;   /**< max |m_i / (M/n) - 1| */
  double quadrature_error; /**< of these masses, relative to M/n */
  double energy;           /**< sum of the cells' second moments about their points */
  double relative_energy;  /**< relative to the best lattice with cells of the same measure */
  size_t apart_cells;      /**< cells with parts that are not connected with the part that has the point */
  double apart_share;      /**< of the domain's area or volume in such parts */
  double apart_distance; /**< of such a part from the part with the point, the median; 0 if there are none */
  size_t layer_count;
  const size_t* layers; /**< the numbers of points on the layers of a surface that were sampled apart */
  double layer_least;   /**< spacing of each point among those of its layer, as in pc_spacing() */
  double layer_mean;
  double layer_hexatic;
  size_t step_count;
  const pc_sampling_step* const* steps; /**< step_count pointers */
} pc_sampling_result;

/** Samples a density by `count` points that start at random. \param options  NULL for the defaults */
POWERCELL_API pc_status pc_sample(const pc_device* device, const pc_domain* domain, size_t count,
                                  const pc_sampling_options* options, const pc_sampling_result** result);
/** The same from given initial points, without layers.
 * \param positions  count x d, row-major; they may lie outside the domain, but no two at the same position */
POWERCELL_API pc_status pc_sample_from(const pc_device* device, const pc_domain* domain,
                                       const double* positions, size_t count,
                                       const pc_sampling_options* options, const pc_sampling_result** result);
POWERCELL_API void pc_sampling_result_destroy(const pc_sampling_result* result);

#ifdef __cplusplus
}
#endif
#endif
