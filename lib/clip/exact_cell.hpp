/// \file
/// Decisions about the cell of one seed in one region of the domain, without rounding and without ties.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace powercell {

struct HostScene;

/// The scale in which all coordinates and weights of a scene are integers.
struct ExactScale {
  int exponent = 0;  ///< coordinates are integers times 2^exponent, weights times 2^(2 exponent)
  int bits = 0;      ///< most bits of a coordinate; twice as many hold a weight
};

/// Of points packed as kernels see them in double (rows x y z weight), finite.
ExactScale exact_scale(std::span<const std::byte> points, std::span<const std::byte> corners);

/// A vertex is given by the planes that meet in it: what lies behind the faces there, as in
/// PieceBatch::border (rank of a seed, or ~facet of the region). Two on polygons and surfaces, three in
/// volumes.
using ExactVertex = std::array<std::int32_t, 3>;

/// Exact predicates in integers (Boost.Multiprecision). Where the numbers as given make a tie, the weight of each
/// seed counts as larger by an infinitesimal, that of a lower rank by an infinitely larger one than all behind it
/// (simulation of simplicity), so that every cell decides alike, in whatever order the seeds were given
/// (docs/mathematics.md, "Certain decisions").
class ExactCell {
 public:
  virtual ~ExactCell() = default;
  /// Whether the vertex is beyond the bisector with seed `other`; not if that is one of its planes.
  virtual bool is_outside(const ExactVertex& vertex, std::int32_t other) = 0;
  /// The vertex relative to the seed, each coordinate within a few rounding errors of itself.
  virtual std::array<double, 3> place(const ExactVertex& vertex) = 0;
  /// Whether the vertex without the infinitesimals lies in the plane of facet `f` of the region.
  virtual bool lies_in_facet(const ExactVertex& vertex, int f) = 0;
  /// Whether vertex `corner` of the domain is beyond the bisector with `other`.
  virtual bool is_corner_outside(std::uint32_t corner, std::int32_t other) = 0;
  /// Dimension of the convex hull of the vertices without the infinitesimals.
  virtual int hull_dimension(std::span<const ExactVertex> vertices) = 0;

  /// \param rank  the cell's seed
  static std::unique_ptr<ExactCell> make(const HostScene& scene, std::uint32_t rank, std::uint32_t region);
};

}  // namespace powercell
