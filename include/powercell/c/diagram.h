/** \file
 * Power diagrams restricted to a domain.
 */
#ifndef POWERCELL_C_DIAGRAM_H
#define POWERCELL_C_DIAGRAM_H

#include <powercell/c/device.h>
#include <powercell/c/domain.h>
#include <powercell/c/options.h>
#include <powercell/c/results.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pc_diagram pc_diagram; /**< a power diagram of seeds in a domain, on a device */
typedef struct pc_results pc_results; /**< results of a diagram that are kept */

/** A diagram without seeds. Device and domain may be destroyed before it.
 * \param options  NULL for the defaults */
POWERCELL_API pc_status pc_diagram_create(const pc_device* device, const pc_domain* domain,
                                          const pc_options* options, pc_diagram** diagram);
POWERCELL_API void pc_diagram_destroy(pc_diagram* diagram);

/** Builds and tests the kernels that diagrams of this kind run on the device, so that the first one takes no
 * longer than the next ones: computes three small ones, with all results. What is built lasts as long as a
 * pc_device of the process on the same device, and in a cache on disk. \param options  NULL for the defaults;
 * `progress` is called as by a diagram */
POWERCELL_API pc_status pc_prepare(const pc_device* device, const pc_domain* domain,
                                   const pc_options* options);

/** Sets the seeds, at most PC_MOST_SEEDS.
 * \param positions  count x d, row-major, unit length (d: 2 in polygons, 3 on surfaces and in volumes)
 * \param weights    count, unit length^2; NULL means all zero */
POWERCELL_API pc_status pc_diagram_set_seeds(pc_diagram* diagram, const double* positions,
                                             const double* weights, size_t count);
#define PC_MOST_SEEDS ((size_t)1 << 30) /**< the most seeds of one diagram */

/** Sets new weights for the same positions; only the work that depends on weights is repeated. */
POWERCELL_API pc_status pc_diagram_set_weights(pc_diagram* diagram, const double* weights, size_t count);

/** From now on computes the cells of some seeds only, against all seeds, until pc_diagram_select_all()
 * or pc_diagram_set_seeds(). Row k of the results is of seed seeds[k]; neighbours and borders name
 * seeds by their index among all.
 * \param seeds  count indices, each once, in any order */
POWERCELL_API pc_status pc_diagram_select(pc_diagram* diagram, const uint32_t* seeds, size_t count);
POWERCELL_API pc_status pc_diagram_select_all(pc_diagram* diagram);
/** 1 from pc_diagram_select() on, else 0. */
POWERCELL_API pc_status pc_diagram_has_selection(const pc_diagram* diagram, int* has_selection);

/** The number of seeds. */
POWERCELL_API pc_status pc_diagram_size(const pc_diagram* diagram, size_t* count);
/** The seeds' positions, in the caller's order: pc_diagram_size() x d, row-major. */
POWERCELL_API pc_status pc_diagram_positions(const pc_diagram* diagram, double* positions);
/** The precision as chosen: PC_FLOAT64 or PC_FLOAT32. */
POWERCELL_API pc_status pc_diagram_precision(const pc_diagram* diagram, pc_precision* precision);
/** Where candidates come from, as chosen: PC_TREE or PC_FLANN. */
POWERCELL_API pc_status pc_diagram_neighbors(const pc_diagram* diagram, pc_neighbors* neighbors);
/** Handles of the domain and the device that the diagram uses, for the caller to destroy. */
POWERCELL_API pc_status pc_diagram_domain(const pc_diagram* diagram, pc_domain** domain);
POWERCELL_API pc_status pc_diagram_device(const pc_diagram* diagram, pc_device** device);

/** Computes the measures, and the adjacency and cells (of a solid the joined cells) where not 0, in as few
 * passes as possible. The functions below compute what is missing, each in a pass of its own. */
POWERCELL_API pc_status pc_diagram_compute(pc_diagram* diagram, int adjacency, int cells);

/** The measures of the cells, in the order of the seeds, or of the selected ones. Any array may be
 * NULL. n rows, d coordinates.
 * \param mass           n: area or volume; 0 where empty
 * \param centroid       n x d, row-major; NaN where empty
 * \param second_moment  n: integral of |x - p_i|^2 over the cell
 * \param status         n: a pc_seed_status each */
POWERCELL_API pc_status pc_diagram_measures(pc_diagram* diagram, double* mass, double* centroid,
                                            double* second_moment, uint8_t* status);

/** The pairs of cells that share a wall, as compressed sparse rows (two calls, see powercell.h).
 * \param offset    n + 1 entries, or NULL for *count alone
 * \param neighbor  *count entries, ascending within a row; NULL for *count and offset alone
 * \param wall      *count entries: length or area of the wall; may be NULL
 * \param count     in: room in neighbor and wall (when neighbor is not NULL); out: number of entries */
POWERCELL_API pc_status pc_diagram_adjacency(pc_diagram* diagram, uint64_t* offset, uint32_t* neighbor,
                                             double* wall, size_t* count);

/** The regular triangulation restricted to the domain (two calls, see powercell.h).
 * \param corners    corners of a simplex: 3 or 4
 * \param simplices  *count rows of `corners` seed indices, or NULL
 * \param count      in: room for rows (when simplices is not NULL); out: number of rows */
POWERCELL_API pc_status pc_diagram_dual(pc_diagram* diagram, int* corners, uint32_t* simplices,
                                        size_t* count);

/** The results in the diagram's memory, without a copy; computed if they are not known yet. They last until a
 * call sets seeds, weights or the selection, even if it fails, or the diagram is destroyed, unless they are
 * held (pc_diagram_hold_results). */
POWERCELL_API pc_status pc_diagram_measures_view(pc_diagram* diagram, const pc_measures** measures);
POWERCELL_API pc_status pc_diagram_adjacency_view(pc_diagram* diagram, const pc_adjacency** adjacency);
/** PC_UNSUPPORTED in a solid, which has no regions that cells could be cut along. */
POWERCELL_API pc_status pc_diagram_cells_view(pc_diagram* diagram, const pc_cells** cells);
POWERCELL_API pc_status pc_diagram_joined_view(pc_diagram* diagram, const pc_joined_cells** joined);
POWERCELL_API pc_status pc_diagram_boundary_walls_view(pc_diagram* diagram, const pc_boundary_walls** walls);
/** PC_UNSUPPORTED if seeds are selected. */
POWERCELL_API pc_status pc_diagram_dual_view(pc_diagram* diagram, const pc_dual** dual);
/** Of the last computation; lasts until the next call with the diagram. */
POWERCELL_API pc_status pc_diagram_timings_view(pc_diagram* diagram, const pc_timings** timings);

/** Keeps all views of the present seeds, those of later calls too, until pc_results_destroy(), also after the
 * seeds change and without the diagram. */
POWERCELL_API pc_status pc_diagram_hold_results(pc_diagram* diagram, pc_results** results);
POWERCELL_API void pc_results_destroy(pc_results* results);

/** Joined cells of the caller's. */
typedef struct pc_joined {
  pc_joined_cells cells;
} pc_joined;

/** Joins the pieces of each cell across the regions of the domain, as pc_diagram_joined_view() does.
 * \param cells  of a diagram in the same domain */
POWERCELL_API pc_status pc_join(const pc_domain* domain, const pc_cells* cells, const pc_joined** joined);
POWERCELL_API void pc_joined_destroy(const pc_joined* joined);

/** The measures of the cells of seeds without a diagram that is kept: arrays as for pc_diagram_set_seeds()
 * and pc_diagram_measures(). */
POWERCELL_API pc_status pc_measure(const pc_device* device, const pc_domain* domain, const double* positions,
                                   const double* weights, size_t count, const pc_options* options,
                                   double* mass, double* centroid, double* second_moment, uint8_t* status);

#ifdef __cplusplus
}
#endif
#endif
