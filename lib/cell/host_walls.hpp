/// \file
/// Measures of a finished cell and its walls without the infinitesimals that break ties, and the walls that
/// lie in facets of the region (docs/mathematics.md, "Certain decisions", "Walls in facets").
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "lib/cell/host_plane.hpp"

namespace powercell {

/// \tparam Cell  HostPolygon or HostPolyhedron, finished and with its moments taken
template <class Cell>
class HostWalls {
 public:
  struct Wall {
    std::int32_t border;
    double measure;
  };

  HostWalls(const Cell& cell, ExactCell& exact, double radius)
      : cell_(cell), exact_(exact), radius_(radius) {}

  /// Whether the cell is exactly flat. If it is not, but no thicker than the rounding of its vertices, sets
  /// its measure to the least positive number and its centroid to the mean of its vertices.
  bool is_flat(std::array<double, 5>& moments) {
    if (moments[0] > plainly_solid * power_of_radius(Cell::dimension)) return false;
    if (is_degenerate()) return true;
    double surface = 0;
    for (std::size_t f = 0; f < cell_.faces(); ++f) surface += cell_.measure(f);
    if (moments[0] > 64 * rounding_unit * radius_ * surface) return false;
    Point mean{};
    for (std::size_t v = 0; v < cell_.size(); ++v) mean = mean + cell_.vertex(v).at;
    mean = 1 / static_cast<double>(cell_.size()) * mean;
    const double measure = std::max(moments[0], std::numeric_limits<double>::min());
    moments = {measure, measure * mean[0], measure * mean[1], measure * mean[2], measure * dot(mean, mean)};
    return false;
  }

  /// The faces of the cell with the infinitesimals, each in the plane that cut it.
  std::vector<Wall> perturbed() {
    std::vector<Wall> walls;
    for (std::size_t f = 0; f < cell_.faces(); ++f) walls.push_back({cell_.border(f), measure_of(f)});
    return walls;
  }

  /// The faces of the cell with the borders and measures of its row in PieceBatch.
  /// \param flat    whether the cell is flat
  /// \param behind  what lies behind the facets of the region (BEHIND_NOTHING in kernels/layout.h)
  std::vector<Wall> settle(const HostRegion& region, const std::int32_t* behind, bool flat) {
    for (std::size_t facet = 0; facet < cell_.facets().size(); ++facet)
      for (std::size_t v = 0; v < cell_.size(); ++v)
        if (may_lie_in(v, facet)) {
          near_.push_back(facet);
          break;
        }
    std::vector<Wall> walls = perturbed();
    for (std::size_t f = 0; f < walls.size() && !near_.empty(); ++f)
      if (walls[f].border >= 0 && walls[f].measure > 0) settle_in_facets(f, region, behind, flat, walls[f]);
    return walls;
  }

 private:
  /// A face or cell is certainly not degenerate if it is larger than this part of the square or cube of the
  /// radius.
  static constexpr double plainly_solid = 1e-9;
  /// Least measure of a wall that is not degenerate, as a part of one that certainly is not: far below
  /// rounding, far above underflow.
  static constexpr double next_to_nothing = 1e-50;

  double power_of_radius(int dimension) const {
    return dimension == 1 ? radius_ : radius_ * power_of_radius(dimension - 1);
  }

  /// Whether the ends of an edge are one point: then the plane that u has and v does not have holds v too.
  bool coincide(std::size_t v, std::size_t u) {
    const HostPoint &a = cell_.vertex(v), &b = cell_.vertex(u);
    for (std::size_t k = 0; k < 3; ++k)
      if (std::fabs(a.at[k] - b.at[k]) > 2 * (a.error + b.error)) return false;
    const ExactVertex here = cell_.borders(v), there = cell_.borders(u);
    const auto end = here.begin() + Cell::dimension;
    const auto* other = std::find_if(there.begin(), there.begin() + Cell::dimension - 1,
                                     [&](int border) { return std::find(here.begin(), end, border) == end; });
    return exact_.lies_in(here, *other);
  }

  /// Whether a face, or a polygon, has no area: all edges with a length are parallel.
  bool has_no_area(std::size_t f) {
    std::optional<std::int32_t> first;
    return cell_.all_edges(f, [&](std::size_t v, std::size_t u, std::int32_t border) {
      if (coincide(v, u)) return true;
      if (first) return exact_.are_parallel(cell_.border(f), *first, border);
      first = border;
      return true;
    });
  }

  bool is_degenerate_wall(std::size_t f) {
    if constexpr (Cell::dimension == 2)
      return coincide(f, cell_.after(f));
    else
      return has_no_area(f);
  }

  bool is_degenerate() {
    if (Cell::dimension == 2) return has_no_area(0);
    for (std::size_t f = 0; f < cell_.faces(); ++f) {
      if (has_no_area(f)) continue;
      for (std::size_t v = 0; v < cell_.size(); ++v)
        if (!exact_.lies_in(cell_.borders(v), cell_.border(f))) return false;
    }
    return true;
  }

  /// The measure of a face: exactly 0 if and only if it is 0 without the infinitesimals. A wall that rounding
  /// made 0 or negative gets a tiny measure.
  double measure_of(std::size_t f) {
    const double plain = plainly_solid * power_of_radius(Cell::dimension - 1), measure = cell_.measure(f);
    if (measure > plain) return measure;
    return is_degenerate_wall(f) ? 0 : std::max(measure, next_to_nothing * plain);
  }

  bool may_lie_in(std::size_t v, std::size_t facet) const {
    const HostPlane& plane = cell_.facets()[facet];
    const HostPoint& p = cell_.vertex(v);
    return std::fabs(dot(plane.normal, p.at) - plane.offset) <=
           HostPlacer::final_error * radius_ + p.error + plane.error;
  }

  bool lies_in_facet(std::size_t f, std::size_t facet) {
    for (std::size_t v = 0; v < cell_.size(); ++v)
      if (cell_.is_on(v, f) &&
          !(may_lie_in(v, facet) && exact_.lies_in(cell_.borders(v), ~static_cast<std::int32_t>(facet))))
        return false;
    return true;
  }

  /// Sets the border of a wall in the plane of a facet: the seed, if it has the region behind the facet (or,
  /// for a flat piece, if the cell itself has that region), else the facet.
  void settle_in_facets(std::size_t f, const HostRegion& region, const std::int32_t* behind, bool flat,
                        Wall& wall) {
    std::vector<std::size_t> in;  // of a polygon whose corners are in line there may be several
    for (const std::size_t facet : near_)
      if (lies_in_facet(f, facet)) in.push_back(facet);
    if (in.empty()) return;
    if constexpr (Cell::dimension == 2)
      if (in.size() > 1 && !region.on_surface) {
        const double open = open_length(f, in, region, behind, next_to_nothing * wall.measure);
        if (open > 0) wall.measure = open;
        if (open != 0) return;
      }
    const std::int32_t there = behind[in.front()];
    if (there == BEHIND_NOTHING ||
        (region.on_surface &&
         exact_.is_corner_outside(static_cast<std::uint32_t>(there), wall.border) == flat))
      wall.border = ~static_cast<std::int32_t>(in.front());
  }

  /// Whether edge f ends before a facet does, or where it begins: exactly.
  bool ends_before(std::size_t f, std::size_t facet) {
    for (const std::size_t beside : {cell_.before(f), cell_.after(f)})
      if (cell_.border(beside) >= 0 &&
          exact_.is_facet_outside(static_cast<std::uint32_t>(facet), cell_.border(beside)))
        return true;
    return false;
  }

  /// The length of a wall in the line of several facets, of which only the part with a region behind it
  /// counts; below 0 if that is the whole wall.
  double open_length(std::size_t f, const std::vector<std::size_t>& facets, const HostRegion& region,
                     const std::int32_t* behind, double least) {
    const Point from = cell_.vertex(f).at, way = cell_.vertex(cell_.after(f)).at - from;
    const double length = norm(way);
    const auto place = [&](std::size_t k) { return dot(region.corner[k] - from, way) / length; };
    double open = 0;
    bool closed = false;
    for (const std::size_t facet : facets) {
      if (ends_before(f, facet)) continue;
      if (behind[facet] == BEHIND_NOTHING) {
        closed = true;
        continue;
      }
      const auto [low, high] =
          std::minmax({place(facet), place(facet + 1 == region.corner.size() ? 0 : facet + 1)});
      open += std::max(std::min(length, high) - std::max(0.0, low), least);
    }
    return closed ? std::min(open, length) : -1;
  }

  const Cell& cell_;
  ExactCell& exact_;
  const double radius_;
  std::vector<std::size_t> near_;  ///< facets that some vertex may lie in
};

}  // namespace powercell
