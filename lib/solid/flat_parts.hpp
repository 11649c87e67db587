/// \file
/// Regions of a plane, given by loops, in convex polygons.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace powercell::solid {

/// Polygons by the numbers of their vertices.
struct Polygons {
  std::vector<std::uint32_t> vertex;
  std::vector<std::size_t> end;

  std::span<const std::uint32_t> loop(std::size_t p) const {
    const std::size_t begin = p == 0 ? 0 : end[p - 1];
    return std::span(vertex).subspan(begin, end[p] - begin);
  }
};

/// Appends convex polygons that tile the region on the left of closed loops: outer ones counter-clockwise,
/// holes clockwise. Their edges, but for those that two of them have in opposite directions, are the edges of
/// the loops, each as often. A region that is convex up to rounding, about which straight vertices do not
/// matter, is one polygon. Where edges of loops cross within rounding, some polygons of the region are
/// clockwise.
/// \param position  two coordinates per vertex number
void append_convex_parts(const Polygons& loops, std::span<const std::array<double, 2>> position,
                         Polygons& out);

}  // namespace powercell::solid
