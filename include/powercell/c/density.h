/** \file
 * Densities on a domain, and the integrals of a density over the cells of a diagram.
 */
#ifndef POWERCELL_C_DENSITY_H
#define POWERCELL_C_DENSITY_H

#include <powercell/c/diagram.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pc_density pc_density; /**< an immutable density: mass per unit of area or volume */

#define PC_LARGEST_DENSITY 1e100 /**< upper limit of a density everywhere */

/** Writes the density at a point (3 coordinates, the third 0 in 2D). Returns 0 to stop the call with
 * PC_INTERRUPTED; an exception of C++ stops it too, and is the message. Several threads call it at a time. */
typedef int (*pc_density_value)(const double* point, double* value, void* user);

/** The same value everywhere, above 0. */
POWERCELL_API pc_status pc_density_constant(double value, pc_density** density);
/** An expression in x, y and z: + - * / ^, comparisons, `a ? b : c`, sin, exp, sqrt, abs, min, max and
 * others.
 * \param tolerance  of each mass, relative, below 1; 0 means 1e-9 */
POWERCELL_API pc_status pc_density_formula(const char* expression, double tolerance, pc_density** density);
/** The same for a function, which must last as long as the handle and all that was made with it. */
POWERCELL_API pc_status pc_density_function(pc_density_value function, void* user, double tolerance,
                                            pc_density** density);
/** Constant in each pixel of an image and 0 outside its rectangle, for polygons only. The integrals are
 * exact.
 * \param values  height x width, row-major from the top row (largest y) down, not negative
 * \param low     lower left corner of the rectangle, 2 doubles
 * \param high    upper right corner, likewise */
POWERCELL_API pc_status pc_density_image(const double* values, size_t width, size_t height, const double* low,
                                         const double* high, pc_density** density);
/** Linear in each triangle or tetrahedron. The integrals are exact.
 * \param values  one per vertex, in the order passed to pc_domain_surface() or pc_domain_volume() */
POWERCELL_API pc_status pc_density_nodal(const double* values, size_t count, pc_density** density);
POWERCELL_API void pc_density_destroy(pc_density* density);

/** 1 if the density is constant, else 0. */
POWERCELL_API pc_status pc_density_is_constant(const pc_density* density, int* is_constant);
/** 1 if integrals are exact up to rounding, which those of formulas and functions are not, else 0. */
POWERCELL_API pc_status pc_density_is_exact(const pc_density* density, int* is_exact);
/** The integral over a domain. \param threads  on the host; 0 means all */
POWERCELL_API pc_status pc_density_total(const pc_density* density, const pc_domain* domain, int threads,
                                         double* total);

/** Receives the n masses before the walls are integrated; returns 0 to skip the walls. */
typedef int (*pc_walls_if)(const double* mass, size_t n, void* user);

/** Options of pc_integrate(). Fill with pc_integration_options_init() first. */
typedef struct pc_integration_options {
  size_t struct_size; /**< set by pc_integration_options_init() */
  int walls;          /**< not 0: integrate over the walls too */
  int threads;        /**< on the host; 0 means all */
  double tolerance; /**< of the masses of a formula or function, if looser than the density's own; below 1 */
  pc_walls_if walls_if; /**< not called if the density is constant; may be NULL */
  void* walls_if_user;  /**< passed to walls_if */
} pc_integration_options;

/** Sets every option to its default. \param struct_size  sizeof(pc_integration_options) */
POWERCELL_API pc_status pc_integration_options_init(pc_integration_options* options, size_t struct_size);

/** Integrals of a density rho over each cell. n seeds, d coordinates. */
typedef struct pc_density_integrals {
  size_t count;                /**< n */
  int dimension;               /**< d */
  const double* mass;          /**< n: integral of rho over the cell; 0 where empty */
  const double* centroid;      /**< n x d, row-major: integral of rho x, over the mass; NaN if that is 0 */
  const double* second_moment; /**< n: integral of rho |x - p_i|^2 */
  const uint8_t* status;       /**< n: a pc_seed_status of each cell, regardless of its mass */
  double domain_mass;          /**< pc_density_total() of the domain */
  double total;                /**< compensated sum of the masses */
  double relative_error;       /**< |total - domain_mass| / domain_mass */
  const double* mass_error;    /**< n: estimated error where quadrature reached its limit; NULL if constant */
  double quadrature_error;     /**< the largest of mass_error */
  /** Integrals of rho over the walls, if requested and not skipped, else NULL. The derivatives of the masses
   * with respect to the weights follow from them. */
  const pc_adjacency* walls;
} pc_density_integrals;

/** Integrates a density over the cells of a diagram. In a periodic domain the density must be constant.
 * \param options  NULL for the defaults */
POWERCELL_API pc_status pc_integrate(pc_diagram* diagram, const pc_density* density,
                                     const pc_integration_options* options,
                                     const pc_density_integrals** integrals);
POWERCELL_API void pc_density_integrals_destroy(const pc_density_integrals* integrals);

#ifdef __cplusplus
}
#endif
#endif
