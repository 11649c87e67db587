/// \file
/// Collects the geometry of clipped pieces into Cells.
#pragma once

#include <cstdint>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/cell/pieces.hpp"
#include "lib/domain/frame.hpp"
#include "lib/domain/region_mesh.hpp"
#include "lib/periodic/images.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {

class GeometryCollector {
 public:
  GeometryCollector(const RegionMesh& mesh, const SeedSet& seeds, const Frame& frame);

  /// From now on cells are placed near the seeds as given, and faces have shifts. Keeps the reference.
  void place(const Placement& placement) { placement_ = &placement; }

  /// Adds the pieces of a chunk in the order of the pairs. Ranks ascend over all chunks.
  void add(std::span<const std::uint32_t> pair_seed, std::span<const std::uint32_t> pair_region,
           const PieceSet& pieces);

  /// Removes the pieces of some ranks, so that others can be added.
  /// \param ranks  ascending
  void discard(std::span<const std::uint32_t> ranks);

  /// The cells in input order, of the seeds whose status is ok.
  /// \param rows  the seeds of the cells
  /// \param rank  of each row, ascending; null where rows are ranks
  Cells finish(const std::vector<SeedStatus>& status, const SeedSet& rows,
               const std::vector<std::uint32_t>* rank = nullptr);

 private:
  static constexpr std::uint32_t discarded = ~std::uint32_t{0};

  void add_vertices(const PieceBatch& batch, std::size_t row, std::uint32_t rank);
  void add_loops(const PieceBatch& batch, std::size_t row);
  Border border(std::int32_t code, std::uint32_t region) const;

  const RegionMesh& mesh_;
  const SeedSet& seeds_;
  const Frame& frame_;
  const Placement* placement_ = nullptr;   // in a periodic domain
  Cells cells_;                            // pieces in the order of the pairs; cell_offset is not set
  std::vector<std::uint32_t> piece_rank_;  // or `discarded`
};

}  // namespace powercell
