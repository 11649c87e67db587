/// \file
/// Tables: one row a seed, or one row a wall.
#pragma once

#include <powercell/results.hpp>
#include <powercell/seeds.hpp>
#include <string>

namespace powercell::io {

/// "ok", "hidden" or "duplicate".
const char* status_name(SeedStatus status);

/// CSV `seed,x,y[,z],weight,status,measure,cx,cy[,cz],second_moment,neighbors`, in input order, every
/// number such that it reads back the same; the centroid is left empty where the cell is empty;
/// `neighbors` is the number of cells with which the cell shares a wall. \throw Error write_failed
void write_table(const std::string& path, const SeedsView& seeds, const Measures& measures,
                 const Adjacency& adjacency);

/// CSV `seed,neighbor,measure`, both directions of each wall, ascending. \throw Error write_failed
void write_walls(const std::string& path, const Adjacency& adjacency);

}  // namespace powercell::io
