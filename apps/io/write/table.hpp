/// \file
/// Tables with one row for each seed, or for each side of a wall.
#pragma once

#include <cstdint>
#include <powercell/results.hpp>
#include <powercell/seeds.hpp>
#include <span>
#include <string>

#include "apps/io/maps/frame.hpp"
#include "apps/io/tables/seed_rows.hpp"

namespace powercell::io {

/// CSV `seed,x,y[,z],weight,status,measure,cx,cy[,cz],second_moment,neighbors`, in input order, after the
/// columns of the seeds' own table (seed_rows.hpp). Numbers read back the same; the centroid of an empty cell
/// is left empty; `neighbors` is the number of cells with a common wall. Points are in the coordinates of the
/// inputs.
/// \param only  the seeds of the results, if they are not all; the rows are theirs, in this order
/// \throw Error write_failed
void write_table(const std::string& path, const SeedsView& seeds, const Measures& measures,
                 const Adjacency& adjacency, const InputView& inputs = {},
                 std::span<const std::uint32_t> only = {});

/// The header of write_table(), with its columns.
SeedRows begin_table(const std::string& path, const SeedsView& seeds, const InputView& inputs = {});
/// A row below it.
/// \param row  of the seed in the measures
void write_row(SeedRows& rows, std::size_t seed, const Measures& measures, std::size_t row,
               std::uint64_t neighbors);

/// What a table of walls has beside the walls between cells.
struct WallColumns {
  int shift_axes = 0;  ///< in a periodic domain its dimension, for `sx,sy[,sz]`: Adjacency::shift
  /// If not null, a column `facet`, and after the walls of a seed a row without a neighbour for each facet.
  const BoundaryWalls* facets = nullptr;
  std::span<const std::uint32_t> only = {};  ///< as in write_table
};

/// CSV `seed,neighbor,measure`, both directions of each wall, ascending; after the measure the columns of
/// WallColumns; if a column of ids was chosen, also `id,neighbor_id`.
/// \throw Error write_failed
void write_walls(const std::string& path, const Adjacency& adjacency, const InputView& inputs = {},
                 const WallColumns& columns = {});

}  // namespace powercell::io
