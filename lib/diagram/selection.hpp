/// \file
/// Cells of some seeds, against all seeds.
#pragma once

#include <cstdint>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// The seeds whose cells are asked for, by the caller's index, in the order of the results.
using Selection = std::vector<std::uint32_t>;

/// \param count  of seeds
/// \throw Error invalid_argument (an index that no seed has, or one that is there twice; names its place)
Selection checked_selection(std::span<const std::uint32_t> seeds, std::size_t count);

/// The cells of a selection in the order in which they are clipped: row r is the cell of rank `rank[r]`.
/// Selected seeds that are set aside have no row.
struct SelectedRows {
  std::vector<std::uint32_t> rank;  ///< ascending
  /// Of the rows. `input` is the place in the selection, `input_count` the number of selected seeds,
  /// `duplicate` the places of duplicates.
  SeedSet seeds;
};

/// \param seeds  all active ones
/// \param own    the ranks that may have cells come before this one
SelectedRows make_rows(const Selection& selection, const SeedSet& seeds, std::uint32_t own, int threads);

/// The rows of a selection, of results for all seeds.
Measures select_rows(const Measures& all, const Selection& selection);
Adjacency select_rows(const Adjacency& all, const Selection& selection);
/// \pre cells of a volume
JoinedCells select_rows(const JoinedCells& all, const Selection& selection);

}  // namespace powercell
