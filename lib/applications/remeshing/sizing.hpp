/// \file
/// How long the edges of the new mesh shall be, by place.
#pragma once

#include <cstddef>
#include <vector>

#include "lib/applications/remeshing/progress.hpp"
#include "lib/applications/remeshing/surface.hpp"

namespace powercell::remeshing {

/// Curvatures at each vertex (docs/mathematics.md (60)). Vertices on kept edges, where they mean nothing,
/// take the mean of their neighbours.
struct Curvature {
  std::vector<double> mean;     ///< |H|, by the cotangent Laplacian
  std::vector<double> largest;  ///< |H| + sqrt(H^2 - K), K by the angle defect: the larger principal one
};
Curvature curvature(const Surface& surface);

/// The shape of the sizing, up to a factor: the larger principal curvature, smoothed over `reach`, clamped at
/// its 5th and 95th percentile by area, to the power -1/2, which makes chords miss the surface by the same
/// everywhere. |H| alone is blind to saddles. `contrast` is the largest ratio of two values.
std::vector<double> relative_sizing(const Surface& surface, double reach, double contrast,
                                    Progress progress = {});

/// Edge lengths h at the vertices of a surface.
struct Sizing {
  std::vector<double> h;
  double gradation = 0;

  double at(const Surface& surface, const Place& place) const;
};

/// The edge length of a mesh of `count` vertices and even spacing: h of docs/mathematics.md (62), and no less
/// than at which the kept edges alone have as many.
double even_spacing(const Surface& surface, std::size_t count);

/// The factor on `shape` with which a mesh of edge length h has `count` vertices (docs/mathematics.md (62)),
/// h limited to grow by `gradation` a unit of length. \throw Error invalid_argument
Sizing scaled_sizing(const Surface& surface, const std::vector<double>& shape, double gradation,
                     std::size_t count, Progress progress = {});

/// Number of vertices that a mesh of edge length h has.
double vertices_for(const Surface& surface, const std::vector<double>& h);

}  // namespace powercell::remeshing
