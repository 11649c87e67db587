/// \file
/// Marks of the seeds in a flat picture.
#pragma once

#include <vector>

#include "apps/io/picture_scene.hpp"

namespace powercell::io {

/// Where domain coordinates lie in the picture.
struct Placement {
  double scale = 1;  ///< pixels per unit
  double left = 0, top = 0;
  double low_x = 0, high_y = 0;
  double x(double at) const { return left + (at - low_x) * scale; }
  double y(double at) const { return top + (high_y - at) * scale; }
};

/// How much larger than true discs of radius sqrt|w| are drawn: 1 where they are legible, else such
/// that the larger ones fill about half of a cell. `spacing` is the width of a mean cell.
double disc_magnification(const SeedsView& seeds, double spacing);

/// Discs of the weights, if they are wanted, largest first, then the dots of the seeds, then those without a
/// cell. Seeds outside the picture are left out.
std::vector<Scene::Disc> make_discs(const DiagramOutput& output, const Placement& placement, double width,
                                    double height, double spacing, double magnification);

}  // namespace powercell::io
