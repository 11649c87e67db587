/** \file
 * Semi-discrete optimal transport: finds weights such that the cells of given seeds have given masses.
 */
#ifndef POWERCELL_C_TRANSPORT_H
#define POWERCELL_C_TRANSPORT_H

#include <powercell/c/density.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pc_transport_solver pc_transport_solver; /**< solves repeatedly as seeds and masses change */

/** Solver for the linear system of a Newton step. */
typedef enum pc_linear_solver {
  PC_LINEAR_AUTOMATIC = 0, /**< chosen by the number of seeds and the dimension of the cells */
  PC_LINEAR_DENSE,         /**< Cholesky on a full matrix, for up to some hundred seeds */
  PC_LINEAR_DIRECT,        /**< sparse Cholesky */
  PC_LINEAR_MULTILEVEL     /**< conjugate gradients, preconditioned by smoothed aggregation */
} pc_linear_solver;

/** Phase of the solver that made a step. */
typedef enum pc_transport_phase {
  PC_PHASE_START = 0, /**< choice of the initial weights; no linear system was solved */
  PC_PHASE_NEWTON,    /**< damped Newton towards the prescribed masses */
  PC_PHASE_RAMP,      /**< damped Newton towards masses raised to a power below 1 */
  PC_PHASE_ASCENT     /**< regularised Newton on the dual, which tolerates empty cells */
} pc_transport_phase;

/** Stable lower-case names, e.g. "multilevel" and "newton"; "unknown" for other numbers. Static storage. */
POWERCELL_API const char* pc_linear_solver_name(pc_linear_solver solver);
POWERCELL_API const char* pc_transport_phase_name(pc_transport_phase phase);

/** One accepted step. m are the masses after the step, v the target masses of its phase. */
typedef struct pc_transport_step {
  int step; /**< from 0, counted through all phases */
  pc_transport_phase phase;
  double exponent;         /**< ramp: v is proportional to this power of the masses, or this share of the way
                                from those at the start, as logarithms */
  double spread;           /**< share of the domain's mass replaced by a uniform density; 0 at the end */
  double error;            /**< max |m_i / v_i - 1| */
  double gradient;         /**< |v - m|, Euclidean */
  double least;            /**< min m_i / v_i */
  size_t empty;            /**< number of cells without mass */
  double dual;             /**< dual value for v */
  double length;           /**< step length, 1 for a full step */
  int diagrams;            /**< diagrams computed for the step */
  pc_linear_solver linear; /**< solver used; automatic if nothing was solved */
  int linear_iterations;   /**< 0 for a direct solver */
  double linear_residual;  /**< |b - L x| / |b| */
  double diagram_seconds;  /**< wall-clock time of all its diagrams */
  double linear_seconds;   /**< wall-clock time of its linear system */
} pc_transport_step;

/** Receives each step; returns 0 to stop the call with PC_INTERRUPTED. */
typedef int (*pc_transport_progress)(const pc_transport_step* step, void* user);

/** Options of a transport. Fill with pc_transport_options_init() first. */
typedef struct pc_transport_options {
  size_t struct_size;        /**< set by pc_transport_options_init() */
  const pc_density* density; /**< mass per unit of area or volume; NULL means 1 everywhere */
  const pc_options* diagram; /**< of the diagrams; NULL for the defaults */
  int periodic;  /**< not 0: a box with its opposite sides identified, short for pc_domain_periodic_box() */
  int max_steps; /**< limit on the steps of all phases together; default 500 */
  /** Converged when max |m_i / v_i - 1| is below this, in [0, 1). 0 means 1e-6, in single precision 1e-3. */
  double tolerance;
  double linear_residual; /**< relative residual of an iterative linear solve, in (0, 1); default 1e-4 */
  pc_linear_solver linear;
  int rescale; /**< not 0: scale the masses so that their sum is the domain's mass; else it must match */
  pc_transport_progress progress; /**< may be NULL */
  void* progress_user;            /**< passed to progress */
} pc_transport_options;

/** Sets every option to its default. \param struct_size  sizeof(pc_transport_options) */
POWERCELL_API pc_status pc_transport_options_init(pc_transport_options* options, size_t struct_size);

/** Result of a solve, in the order of the n seeds. */
typedef struct pc_transport_result {
  size_t count;                /**< n */
  int dimension;               /**< d */
  int converged;               /**< 1 or 0; if 0, the result is the best iterate */
  double error;                /**< max |m_i / v_i - 1| */
  double quadrature_error;     /**< largest estimated quadrature error of m_i, relative to v_i */
  double rounding_error;       /**< a bound for the error of m_i, relative to v_i, that comes of weights being
                                  doubles */
  double tolerance;            /**< as used */
  const double* weights;       /**< n, length^2: with mean 0 over the seeds that are not merged */
  const double* target;        /**< n: v, the prescribed masses, rescaled if requested */
  const double* mass;          /**< n: masses of the cells; 0 for merged seeds */
  const double* centroid;      /**< n x d, row-major; NaN for empty cells and merged seeds */
  const double* second_moment; /**< n: integral of |x - p_i|^2 over the cell */
  const uint32_t*
      merged_with;   /**< n: the seed with the lowest index at the same position; itself unless merged */
  size_t merged;     /**< number of seeds merged with another */
  double total_mass; /**< of the domain */
  double primal;     /**< cost of moving the cells' masses to their seeds; W2^2 when converged */
  double dual;       /**< a lower bound of W2^2 at any weights */
  size_t step_count;
  const pc_transport_step* const* steps; /**< step_count pointers */
  size_t newton_steps;                   /**< number of steps that solved a linear system */
  size_t diagrams;                       /**< number of diagrams computed */
} pc_transport_result;
POWERCELL_API void pc_transport_result_destroy(const pc_transport_result* result);

/** Solves once. Failure to converge is not a failure of the call: see `converged`.
 * \param positions  count x d, row-major
 * \param weights    count: from which to start; NULL means all zero
 * \param masses     count: all positive; NULL means equal masses
 * \param options    NULL for the defaults */
POWERCELL_API pc_status pc_transport(const pc_device* device, const pc_domain* domain,
                                     const double* positions, const double* weights, size_t count,
                                     const double* masses, const pc_transport_options* options,
                                     const pc_transport_result** result);

/** A solver without seeds. Device, domain and density may be destroyed before it, but not what a
 * function of pc_density_function() uses.
 * \param options  NULL for the defaults */
POWERCELL_API pc_status pc_transport_solver_create(const pc_device* device, const pc_domain* domain,
                                                   const pc_transport_options* options,
                                                   pc_transport_solver** solver);
POWERCELL_API void pc_transport_solver_destroy(pc_transport_solver* solver);
/** Sets new seeds. The next solve starts from their weights, or from 0 for NULL. The masses are kept if there
 * are as many seeds as before, else reset to equal ones. */
POWERCELL_API pc_status pc_transport_solver_set_seeds(pc_transport_solver* solver, const double* positions,
                                                      const double* weights, size_t count);
/** Moves the seeds; the next solve starts from weights that suit the move. */
POWERCELL_API pc_status pc_transport_solver_move_seeds(pc_transport_solver* solver, const double* positions,
                                                       size_t count);
/** Sets the weights from which the next solve starts. */
POWERCELL_API pc_status pc_transport_solver_set_weights(pc_transport_solver* solver, const double* weights,
                                                        size_t count);
/** Sets the target masses, all positive; NULL and 0 mean equal masses. */
POWERCELL_API pc_status pc_transport_solver_set_masses(pc_transport_solver* solver, const double* masses,
                                                       size_t count);
/** Changes the tolerance, e.g. for a rough solve within a loop. 0 means that of the options. */
POWERCELL_API pc_status pc_transport_solver_set_tolerance(pc_transport_solver* solver, double tolerance);
/** Changes the limit on steps. */
POWERCELL_API pc_status pc_transport_solver_set_max_steps(pc_transport_solver* solver, int steps);
/** Solves from the current weights. \param result  a copy for the caller; NULL for none */
POWERCELL_API pc_status pc_transport_solver_solve(pc_transport_solver* solver,
                                                  const pc_transport_result** result);
/** A copy of the result of the last solve. */
POWERCELL_API pc_status pc_transport_solver_result(const pc_transport_solver* solver,
                                                   const pc_transport_result** result);
/** The diagram of all seeds with the weights of the last solve. It belongs to the solver: do not destroy it
 * or set its seeds. It and its views last until the next call that solves or sets seeds. PC_INVALID_ARGUMENT
 * before the first solve, or if seeds were set or moved since. */
POWERCELL_API pc_status pc_transport_solver_diagram(pc_transport_solver* solver, pc_diagram** diagram);

#ifdef __cplusplus
}
#endif
#endif
