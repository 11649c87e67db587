/// \file
/// The sizing field: target edge lengths of the new mesh.
#pragma once

#include <cstddef>
#include <vector>

#include "lib/applications/remeshing/progress.hpp"
#include "lib/applications/remeshing/surface.hpp"

namespace powercell::remeshing {

/// Discrete curvatures at each vertex, (60).
struct Curvature {
  std::vector<double> mean;  ///< |H| by the cotangent Laplacian; 0 on kept edges, where it is not defined
  /// The larger principal curvature, |H| + sqrt(H^2 - K), with K by the angle defect. On kept edges the mean
  /// of the neighbours.
  std::vector<double> largest;
};
Curvature curvature(const Surface& surface);

/// The sizing up to a factor, (61): the larger principal curvature to the power -1/2, which makes the
/// distance of chords from the surface uniform. (|H| would be small at saddles.)
/// \param reach     the curvature is smoothed over this distance and clamped at its 5th and 95th percentile
///   by area
/// \param contrast  largest ratio of two values
/// \return per vertex, with the minimum 1
std::vector<double> relative_sizing(const Surface& surface, double reach, double contrast,
                                    Progress progress = {});

/// Target edge lengths h at the vertices of a surface.
struct Sizing {
  std::vector<double> h;
  double gradation = 0;

  /// Interpolates linearly.
  double at(const Surface& surface, const Place& place) const;
};

/// The edge length of a uniform mesh of `count` vertices, h of (62), at least such that the kept edges alone
/// do not need more vertices.
double even_spacing(const Surface& surface, std::size_t count);

/// Scales `shape` such that a mesh with these edge lengths has `count` vertices, (62), with the gradient of h
/// limited to `gradation`, and small components with vertices enough to keep their shape.
Sizing scaled_sizing(const Surface& surface, const std::vector<double>& shape, double gradation,
                     std::size_t count, Progress progress = {});

/// The number of vertices of a mesh with edge lengths h, (62).
double vertices_for(const Surface& surface, const std::vector<double>& h);

}  // namespace powercell::remeshing
