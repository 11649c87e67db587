/** \file
 * powercell for C: power diagrams of weighted points in a polygon, on a surface or in a volume, and what is
 * built on them. Programs of each part are in examples/.
 *
 * The power distance of x to seed i is |x - p_i|^2 - w_i, so a weight has the unit length^2 (for a disc
 * or ball of radius r around p_i, w_i = r^2), may have any sign, and a constant added to all weights
 * changes nothing.
 *
 * Functions return a pc_status and write their results through their last arguments. After a failure
 * pc_last_error() describes it, in the calling thread, and nothing else is written but the *count of two
 * calls (below). Handles are opaque and freed by the matching _destroy function, which accepts NULL. Arrays
 * of the caller are copied.
 *
 * Results come in three ways:
 * - Numbers and arrays whose size the caller knows are written into memory of the caller.
 * - An array whose size is not known beforehand takes two calls: the first with NULL for the array sets only
 *   *count; the second takes an array of at least that many entries. If the array is too short nothing is
 *   written and the call fails with PC_INVALID_ARGUMENT.
 * - Structs of results belong to the library, which hands out pointers to const. Those of functions that
 *   end in _view belong to a handle and last as their function says; all others last until the matching
 *   _destroy function. An array without entries may be NULL. Later versions may add members at the end: do
 *   not copy such a struct by its size.
 *
 * Structs of options are the caller's. Their _init function takes the size of the struct as the caller knows
 * it and sets each option to its default: `pc_options options; pc_options_init(&options, sizeof options);`.
 * So programs go on to work with later versions of the library, whose structs may be longer. NULL stands for
 * the defaults.
 *
 * Use a handle in one thread at a time; different threads may use different handles. Devices, domains and
 * densities do not change, and threads may share them.
 */
#ifndef POWERCELL_H
#define POWERCELL_H

#include <powercell/c/base.h>
#include <powercell/c/communicator.h>
#include <powercell/c/density.h>
#include <powercell/c/device.h>
#include <powercell/c/diagram.h>
#include <powercell/c/distributed.h>
#include <powercell/c/domain.h>
#include <powercell/c/local_diagram.h>
#include <powercell/c/options.h>
#include <powercell/c/out_of_core.h>
#include <powercell/c/point_sets.h>
#include <powercell/c/redistributed_seeds.h>
#include <powercell/c/remeshing.h>
#include <powercell/c/results.h>
#include <powercell/c/sampling.h>
#include <powercell/c/shapes.h>
#include <powercell/c/transport.h>
#include <powercell/c/treemap.h>
#include <powercell/c/triangulation.h>
#include <powercell/c/verify.h>

#endif
