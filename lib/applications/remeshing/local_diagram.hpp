/// \file
/// The power diagram of seeds restricted to a surface, under insertion and removal of seeds.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/applications/remeshing/seed_grid.hpp"
#include "lib/applications/remeshing/surface.hpp"
#include "lib/base/convex_ring.hpp"

namespace powercell::remeshing {

/// A corner of a piece; its edge has the neighbour across it: a seed, or ~k for edge k of the triangle.
using Corner = RingCorner<Vec, std::int32_t>;
using Ring = ConvexRing<Vec, std::int32_t>;

/// The intersection of a cell and a triangle: a convex polygon, oriented as the triangle.
struct Piece {
  std::uint32_t seed, triangle;
  std::uint32_t rank;  ///< in the list of its cell
  Ring ring;
};

struct Seed {
  Vec at;
  double weight = 0;
  double size = 1;  ///< target edge length, used by the search only
  bool alive = false;
};

/// The cells agree with those of powercell::Diagram up to rounding. Insertion and removal take a time that
/// depends on the neighbours only: a new cell is cut out of the cells that it reaches, and a removed cell is
/// divided among the seeds that can reach into it (docs/mathematics.md, "Remeshing"). The caller must avoid
/// degenerate positions (four seeds on a circle, a bisector along an edge).
class LocalDiagram {
 public:
  /// \param surface  kept by reference
  explicit LocalDiagram(const Surface& surface) : surface_(surface), owners_(surface.size()) {}

  /// Adds a seed.
  /// \return its index, which is that of a removed seed if there is one
  std::uint32_t insert(Vec at, double weight, double size);
  void remove(std::uint32_t seed);

  const Surface& surface() const { return surface_; }
  std::size_t size() const { return seeds_.size(); }  ///< indices in use, including removed seeds
  std::size_t alive() const { return seeds_.size() - free_seeds_.size(); }
  const Seed& seed(std::uint32_t i) const { return seeds_[i]; }
  const std::vector<std::uint32_t>& pieces(std::uint32_t i) const { return cells_[i].pieces; }
  const std::vector<std::uint32_t>& pieces_in(std::uint32_t triangle) const { return owners_[triangle]; }
  const Piece& piece(std::uint32_t p) const { return pieces_[p]; }
  /// The seeds whose cells the last insertion or removal changed, including the seed itself; distinct.
  const std::vector<std::uint32_t>& changed() const { return changed_; }
  /// (1): |x - p_i|^2 - w_i
  double power(std::uint32_t i, Vec x) const { return norm2(x - seeds_[i].at) - seeds_[i].weight; }
  /// The largest power distance from a point of the cell to its seed; -infinity if the cell is empty.
  double reach(std::uint32_t i) const { return cells_[i].reach; }
  /// The neighbours of a cell, ascending.
  std::vector<std::uint32_t> neighbors(std::uint32_t i) const;

 private:
  struct Cell {
    std::vector<std::uint32_t> pieces;
    double reach = 0;
  };

  Ring ring_of(std::uint32_t triangle) const;
  bool cut(Ring& ring, std::uint32_t i, std::uint32_t j);
  void add_piece(std::uint32_t seed, std::uint32_t triangle, const Ring& ring);
  void drop_piece(std::uint32_t piece);
  void mark_changed(std::uint32_t seed);
  void finish();
  void take_from(std::uint32_t seed, std::vector<std::uint32_t>& affected);
  std::vector<std::uint32_t> heirs(std::uint32_t seed, const std::vector<std::uint32_t>& pieces) const;
  std::vector<std::uint32_t> gainers(const Ring& freed, const std::vector<std::uint32_t>& heirs);
  bool cut_by_others(Ring& ring, std::uint32_t j, const std::vector<std::uint32_t>& seeds);
  void share_out(std::uint32_t seed, std::uint32_t piece, const std::vector<std::uint32_t>& heirs);
  std::uint32_t find(std::uint32_t triangle, std::uint32_t seed) const;

  const Surface& surface_;
  std::vector<Seed> seeds_;
  std::vector<Cell> cells_;
  std::vector<Piece> pieces_;
  std::vector<std::vector<std::uint32_t>> owners_;  // per triangle: its pieces
  std::vector<std::uint32_t> free_seeds_, free_pieces_, changed_;
  std::vector<char> is_changed_;
  std::vector<double> side_;
  Ring scratch_;
  SeedGrid grid_;
  double most_reach_ = 0;  // upper bound of the reach of all cells
  std::size_t since_measured_ = 0;
};

}  // namespace powercell::remeshing
