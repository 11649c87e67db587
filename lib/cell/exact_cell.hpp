/// \file
/// Decisions about the cell of one seed in one region of the domain, without rounding and without ties.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "lib/base/two_doubles.hpp"

namespace powercell {

struct HostScene;

/// A vertex, given by the planes that meet in it. Each is a border as in PieceBatch: the rank of a seed, or
/// ~facet of the region. Polygons and surfaces have two, volumes three.
using ExactVertex = std::array<std::int32_t, 3>;

/// A point relative to a seed, to some 100 bits.
using ClosePoint = std::array<TwoDoubles, 3>;

/// Exact predicates in integers that are as short as the seeds allow. Ties are broken by simulation of
/// simplicity: the weight of each seed counts as larger by an infinitesimal, which is infinitely larger than
/// those of all higher ranks. So all cells decide alike, whatever the order in which the seeds were given
/// (docs/mathematics.md (86)).
class ExactCell {
 public:
  /// Relative error of the coordinates that place() returns.
  static constexpr double place_error = 2 * TwoDoubles::rounding;

  explicit ExactCell(const HostScene& scene);
  ~ExactCell();
  ExactCell(ExactCell&&) noexcept;

  /// From now on all decisions are about the cell of seed `rank` in `region`.
  void start(std::uint32_t rank, std::uint32_t region);
  /// Whether the infinitesimals decided any side since start().
  bool met_tie() const { return met_tie_; }
  /// Replaces the answer of met_tie(), for decisions on which the result does not depend.
  void set_met_tie(bool met) { met_tie_ = met; }
  /// Whether the vertex is beyond the bisector with seed `other`; false if that is one of its planes.
  bool is_outside(const ExactVertex& vertex, std::int32_t other);
  /// The vertex relative to the seed; each coordinate is off by place_error of itself at most.
  ClosePoint place(const ExactVertex& vertex);
  /// Whether the vertex without the infinitesimals lies in the plane of `border`.
  bool lies_in(const ExactVertex& vertex, std::int32_t border);
  /// Whether the planes of `a` and `b` meet that of `face` in parallel lines; in polygons `face` is not used.
  bool are_parallel(std::int32_t face, std::int32_t a, std::int32_t b);
  /// Whether vertex `corner` of the domain is beyond the bisector with `other`.
  bool is_corner_outside(std::uint32_t corner, std::int32_t other) const;
  /// Whether the bisector with `other` keeps no point of a facet of the region except its ends. In the plane.
  bool is_facet_outside(std::uint32_t facet, std::int32_t other) const;

 private:
  struct Planes;
  std::uint32_t corner_in_line(const ExactVertex& vertex) const;
  bool corner_lies_in(std::uint32_t corner, std::int32_t border) const;
  void start_kind(std::size_t kind);
  template <std::size_t kind, std::size_t count, class Use>
  auto with(const std::array<std::int32_t, count>& borders, const Use& use);

  const HostScene* scene_;
  std::uint32_t rank_ = 0, region_ = 0;
  bool met_tie_ = false;
  std::size_t kind_ = 0;  ///< of the integers in use, ascending with their length
  std::unique_ptr<Planes> planes_;
};

}  // namespace powercell
