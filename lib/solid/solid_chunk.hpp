/// \file
/// The cells of some ranks at the boundary of a solid.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lib/solid/solid_cells.hpp"

namespace powercell::solid {

/// Computes the cells of a chunk of ranks.
class Chunk {
 public:
  /// Keeps the references.
  /// \param alone  per triangle of the boundary: it lies in one cell as a whole
  Chunk(const SolidCellsInput& input, const std::vector<bool>& alone, std::span<const std::uint32_t> ranks);

  void clip_facets(Clipper& clipper);
  /// Clips the whole cells that the boundary meets, and computes their parts.
  void clip_cells(std::optional<ClipMemory>& memory, ClipStatistics& statistics, SideHints& hints);
  void append_to(SolidCells& all);

 private:
  enum class Kind : std::uint8_t { done, uniform, flat, unclear, again };
  struct Outcome {
    Kind kind = Kind::unclear;
    std::array<SolidPart, 2> part;  // the first only, unless uniform
    std::array<CellFaces, 2> faces;
    std::vector<std::uint32_t> neighbors;
    bool reaches_out = false;
    std::vector<SolidCells::Coincidence> coincidences;
  };
  struct Touched {
    std::uint32_t rank;
    std::size_t first, last;  // pieces
    bool tied;
    double radius;  // the distance of its farthest boundary piece
  };

  void find_touched();
  std::vector<double> boxes() const;
  void compute(const PieceSet& cells, std::span<const std::size_t> which, bool in_container,
               SideHints& hints);
  void compute_one(CellInSolid& in_solid, const PieceSet& cells, std::size_t pair, const Touched& touched,
                   bool in_container, Outcome& outcome, SideHints& hints) const;
  void find_coincidences(const CellInSolid& in_solid, const WholeCell& cell, const Touched& touched,
                         Outcome& outcome) const;
  void leave_hints(std::uint32_t rank, const CellInSolid& in_solid, const WholeCell& cell,
                   SideHints& hints) const;
  /// A part of a triangle that is not empty: a clipped pair, or the whole triangle.
  struct Piece {
    std::uint32_t triangle, pair;
  };
  /// The corners of a triangle relative to a seed, in device units.
  std::array<double, 9> corners_of(std::uint32_t triangle, std::uint32_t rank) const;
  /// \param memory  for the corners of whole triangles
  std::vector<BoundaryPiece> pieces_of(const Touched& touched, std::vector<double>& memory) const;

  static constexpr std::uint32_t whole = ~std::uint32_t{0};
  const SolidCellsInput& input_;
  const std::vector<bool>& alone_;
  std::span<const std::uint32_t> ranks_;
  const bool has_tetrahedra_;
  double rounding_;                      // of coordinates
  std::optional<HostScene> host_scene_;  // of the triangles, if seeds of a solid tie with them
  std::vector<Piece> piece_;
  const PieceSet* clipped_ = nullptr;
  std::vector<Touched> touched_;
  std::vector<Outcome> outcome_;  // of touched_
  std::vector<std::uint32_t> tied_alone_;
};

}  // namespace powercell::solid
