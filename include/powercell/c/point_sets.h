/** \file
 * Random points, and measures of how even a set of points is: spacing, hexatic order and spectra.
 */
#ifndef POWERCELL_C_POINT_SETS_H
#define POWERCELL_C_POINT_SETS_H

#include <powercell/c/density.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Draws independent random points of the domain with the given density; the same random seed gives the
 * same points.
 * \param positions  count x d, row-major */
POWERCELL_API pc_status pc_random_points(const pc_domain* domain, const pc_density* density, size_t count,
                                         uint64_t random_seed, double* positions);

/** Measures the spacing of points. Any result may be NULL.
 * \param positions  count x d, row-major, in the domain
 * \param periodic   not 0: the domain is a box with its opposite sides identified
 * \param uniform    not 0: the points are meant to have constant density
 * \param options    of the diagram; NULL for the defaults
 * \param least      the least distance of a point to its nearest neighbour, divided by the densest lattice's
 * \param mean       the mean of these distances, divided likewise
 * \param hexatic    1 in the hexagonal lattice, about 0.37 for random points; NaN unless in the plane */
POWERCELL_API pc_status pc_spacing(const pc_device* device, const pc_domain* domain, const double* positions,
                                   size_t count, int periodic, int uniform, const pc_options* options,
                                   double* least, double* mean, double* hexatic);

/** Power spectrum of points in a periodic box. The components of frequencies are whole numbers of waves per
 * width and height. Random points have the power 1 on average. */
typedef struct pc_spectrum {
  int highest;         /**< F: components of frequencies range from -F to F */
  const double* power; /**< (2F+1) x (2F+1), row-major: rows by f_y, columns by f_x, both ascending */
  size_t points;
  size_t runs;                     /**< number of point sets averaged */
  const double* radial_mean;       /**< F: for |f| = 1, 2, ... the mean of the power over a ring of width 1 */
  const double* radial_anisotropy; /**< F: variance over the ring over the square of the mean */
} pc_spectrum;

/** Computes the power spectrum of points.
 * \param box        its bounding box is the period
 * \param positions  count x 2, row-major
 * \param highest    F; 0 means 2 sqrt(count), rounded up
 * \param threads    on the host; 0 means all */
POWERCELL_API pc_status pc_spectrum_create(const pc_domain* box, const double* positions, size_t count,
                                           int highest, int threads, const pc_spectrum** spectrum);
/** Averages spectra of this library, weighted by their runs. */
POWERCELL_API pc_status pc_spectrum_mean(const pc_spectrum* const* spectra, size_t count,
                                         const pc_spectrum** mean);
/** Mean power over the frequencies 0 < |f| <= fraction * sqrt(points); 0 if there are none. */
POWERCELL_API pc_status pc_spectrum_low_frequency(const pc_spectrum* spectrum, double fraction,
                                                  double* power);
POWERCELL_API void pc_spectrum_destroy(const pc_spectrum* spectrum);

#ifdef __cplusplus
}
#endif
#endif
