/// \file
/// Collects how much of the domain's boundary each cell has.
#pragma once

#include <cstdint>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/cell/pieces.hpp"
#include "lib/domain/region_mesh.hpp"

namespace powercell {

class FacetCollector {
 public:
  /// Keeps the reference.
  explicit FacetCollector(const RegionMesh& mesh) : mesh_(mesh) {}

  /// Adds the pieces of a chunk, with all faces (OUTPUT_FACETS).
  /// \param pair_row  in ascending order
  void add(std::span<const std::uint32_t> pair_row, std::span<const std::uint32_t> pair_region,
           const PieceSet& pieces);

  /// The facets of the cells whose status is ok, measures times `unit`. To be called once.
  /// \param place  of each row in the results
  /// \param status  by place
  BoundaryWalls finish(std::span<const std::uint32_t> place, const std::vector<SeedStatus>& status,
                       double unit);

 private:
  struct Part {
    std::uint32_t row, facet;
    double measure;
  };
  const RegionMesh& mesh_;
  std::vector<Part> parts_;
};

/// The same from the joined cells of a solid.
BoundaryWalls facets_of(const JoinedCells& cells);

}  // namespace powercell
