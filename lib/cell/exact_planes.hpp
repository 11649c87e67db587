/// \file
/// The planes around one seed as rows of integers: bisectors and facets of its region.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lib/cell/exact_rows.hpp"

namespace powercell {

struct HostScene;
struct RegionMesh;

/// What stands for the plane of a surface's triangle among facets and seeds.
constexpr std::int32_t ground_border = INT32_MIN;

/// Of one seed and region, in units of 2^exponent() (offsets: of its square): exact, as long as the numbers
/// met fit rows of this kind. The unit follows the seeds met, so that close together short integers do.
template <class Row>
class ExactPlanes {
 public:
  void start(const HostScene& scene, std::uint32_t rank, std::uint32_t region);
  /// The rows of `borders`, made if need be, good until the next call; the first is null if one does not fit:
  /// then no more of this kind will do.
  template <std::size_t count>
  std::array<const Row*, count> rows(const std::array<std::int32_t, count>& borders) {
    std::array<const Row*, count> found{};
    for (;;) {
      std::size_t k = 0;
      while (k < count && (found[k] = table_.find(borders[k])) != nullptr) ++k;
      if (k == count) return found;
      if (!make(borders[k])) return {};
    }
  }
  int exponent() const { return exponent_; }

 private:
  bool make(std::int32_t border);
  /// Takes numbers into account whose bits are from 2^low to below 2^high; false if the range is too wide.
  /// The unit may change, and all rows with it.
  bool cover(int low, int high);
  void set_unit(int exponent);
  bool make_bisector(std::int32_t other, Row& row);
  bool make_short_bisector(std::int32_t other, Row& row) const;
  bool make_facet(std::int32_t border, Row& row);

  const HostScene* scene_ = nullptr;
  std::uint32_t rank_ = 0, first_ = 0;
  int corners_ = 0;
  int low_ = 0, high_ = 0, exponent_ = 0;
  double scale_ = 0;  ///< 2^-exponent, or 0 if that is no double
  bool any_ = false;
  RowTable<Row> table_;
};

/// The vertex of the domain that is corner k of a region, counted around it.
std::uint32_t corner_of_region(const RegionMesh& mesh, std::uint32_t region, std::uint32_t k);

/// 1 if vertex `corner` of the domain is beyond the bisector of the seeds `rank` and `other`, -1 if within, 0
/// if on it.
int corner_side(const HostScene& scene, std::uint32_t rank, std::uint32_t corner, std::int32_t other);

/// Whether vertex `corner` of a domain in the plane lies in the line of a facet.
bool is_in_line_of_facet(const HostScene& scene, std::uint32_t region, std::uint32_t corner,
                         std::uint32_t facet);

}  // namespace powercell
