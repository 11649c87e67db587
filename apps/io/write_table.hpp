/// \file
/// Tables with one row for each seed, or for each side of a wall.
#pragma once

#include <powercell/results.hpp>
#include <powercell/seeds.hpp>
#include <string>

namespace powercell::io {

/// CSV `seed,x,y[,z],weight,status,measure,cx,cy[,cz],second_moment,neighbors`, in input order. Numbers read
/// back the same; the centroid of an empty cell is left empty; `neighbors` is the number of cells with a
/// common wall. \throw Error write_failed
void write_table(const std::string& path, const SeedsView& seeds, const Measures& measures,
                 const Adjacency& adjacency);

/// CSV `seed,neighbor,measure`, both directions of each wall, ascending. \throw Error write_failed
void write_walls(const std::string& path, const Adjacency& adjacency);

}  // namespace powercell::io
