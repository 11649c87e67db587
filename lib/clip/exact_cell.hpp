/// \file
/// Decisions about the cell of one seed in one region of the domain, without rounding and without ties.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace powercell {

struct HostScene;

/// A vertex is given by the planes that meet in it: what lies behind the faces there, as in
/// PieceBatch::border (rank of a seed, or ~facet of the region). Two on polygons and surfaces, three in
/// volumes.
using ExactVertex = std::array<std::int32_t, 3>;

/// Exact predicates in integers, as short as the seeds met allow. Where the numbers as given make a tie, the
/// weight of each seed counts as larger by an infinitesimal, that of a lower rank by an infinitely larger one
/// than all behind it (simulation of simplicity), so that every cell decides alike, in whatever order the
/// seeds were given (docs/mathematics.md, "Certain decisions").
class ExactCell {
 public:
  explicit ExactCell(const HostScene& scene);
  ~ExactCell();
  ExactCell(ExactCell&&) noexcept;

  /// Decisions are about the cell of seed `rank` in `region` from now on.
  void start(std::uint32_t rank, std::uint32_t region);
  /// Whether the vertex is beyond the bisector with seed `other`; not if that is one of its planes.
  bool is_outside(const ExactVertex& vertex, std::int32_t other);
  /// The vertex relative to the seed, each coordinate within a few rounding errors of itself.
  std::array<double, 3> place(const ExactVertex& vertex);
  /// Whether the vertex without the infinitesimals lies in the plane of `border`.
  bool lies_in(const ExactVertex& vertex, std::int32_t border);
  /// Whether, in the plane of `face`, those of `a` and `b` leave parallel lines; on polygons `face` does not
  /// count.
  bool are_parallel(std::int32_t face, std::int32_t a, std::int32_t b);
  /// Whether vertex `corner` of the domain is beyond the bisector with `other`.
  bool is_corner_outside(std::uint32_t corner, std::int32_t other) const;
  /// Whether no point of a facet of the region but its ends is within the bisector with `other`. In the
  /// plane.
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
  std::size_t kind_ = 0;  ///< of the integers in use, ascending with their length
  std::unique_ptr<Planes> planes_;
};

}  // namespace powercell
