/// \file
/// Tables with one row for each seed, or for each side of a wall.
#pragma once

#include <powercell/results.hpp>
#include <powercell/seeds.hpp>
#include <string>

#include "apps/io/map_frame.hpp"

namespace powercell::io {

/// CSV `seed,x,y[,z],weight,status,measure,cx,cy[,cz],second_moment,neighbors`, in input order, after the
/// columns of the seeds' own table (seed_rows.hpp). Numbers read back the same; the centroid of an empty cell
/// is left empty; `neighbors` is the number of cells with a common wall. Points are in the coordinates of the
/// inputs. \throw Error write_failed
void write_table(const std::string& path, const SeedsView& seeds, const Measures& measures,
                 const Adjacency& adjacency, const InputView& inputs = {});

/// CSV `seed,neighbor,measure`, both directions of each wall, ascending; if a column of ids was chosen, also
/// `id,neighbor_id`. \param shift_axes  in a periodic domain its dimension, for columns `sx,sy[,sz]` after
/// the measure: Adjacency::shift. \throw Error write_failed
void write_walls(const std::string& path, const Adjacency& adjacency, const InputView& inputs = {},
                 int shift_axes = 0);

}  // namespace powercell::io
