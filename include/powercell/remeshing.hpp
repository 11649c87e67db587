/// \file
/// Remeshing: a new triangle mesh of a surface, with a given number of vertices, well-shaped triangles and
/// edges that are shorter where the surface bends more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <powercell/device.hpp>
#include <powercell/error.hpp>
#include <powercell/shapes.hpp>
#include <span>
#include <vector>

namespace powercell {

enum class RemeshMethod {
  /// Each point in turn is taken out and set in again where it is farthest from the others (Yan, Guo, Zhang,
  /// Wonka 2014; weights by curvature as in Xiao, Cao, Xu, Chen 2023); the restricted power diagram is
  /// updated where it changes. On the host, in one thread.
  farthest_point,
  /// Points move to the centroids of cells of equal mass for the density h^-2 (see transport.hpp).
  transport,
};

struct RemeshOptions {
  RemeshMethod method = RemeshMethod::farthest_point;
  std::size_t count = 5000;  ///< vertices of the new mesh, met exactly
  double gradation = 0.2;    ///< most that the edge length h grows over a unit of length; above 0
  double contrast = 4;       ///< largest ratio of two edge lengths wanted; 1: a uniform mesh
  double sharp_angle = 45;   ///< degrees; edges whose two normals differ by more are kept, and boundaries
  int rounds = 20;           ///< at most: both methods stop when the points rest
  int relaxations = 15;      ///< rounds of the last relaxation; 0: the dual as it is (but for its count)
  std::uint64_t random_seed = 1;  ///< the same seed gives the same mesh
  /// For transport; nothing: as Device::choose() does.
  std::optional<Device> device;
  /// Called with the fraction done, which never falls, some times a second up to meshes of 10^5 triangles;
  /// returning false stops with Error interrupted.
  std::function<bool(double)> progress;
};

struct RemeshResult {
  TriangleMesh mesh;                  ///< oriented as the input's first triangle of each component
  std::vector<bool> fixed;            ///< per vertex: on a boundary, a sharp edge or a corner
  std::vector<double> sizing;         ///< per vertex: the edge length h wanted there
  std::vector<double> least_spacing;  ///< after each round: the least distance of two neighbours over h
  std::size_t added = 0;              ///< points more than `count` that the dual needed, collapsed again
  double seconds_sample = 0, seconds_dual = 0, seconds_relax = 0;  ///< of wall time
};

/// A new mesh of a surface: points are spread over it, and the dual of their cells is relaxed.
///
/// The surface is given as a manifold triangle mesh, open or closed. The vertices of the new one lie on it;
/// it is a manifold with the same Euler characteristic and boundary loops; boundaries, edges sharper than
/// `sharp_angle` and their corners are made of its edges and vertices.
/// \param vertices nv x 3, row-major   \param triangles nt x 3 indices from 0
/// \throw Error invalid_domain: what Domain::surface refuses of sizes, indices and coordinates; triangles of
/// no area, edges of more than two triangles (named), a surface that cannot be oriented, one so thin that its
/// triangles, cut to the spacing of the new points, would be more than 10^5 and out of all proportion to
/// these; invalid_argument: options out of range, too few points for the topology or the kept edges;
/// interrupted; for transport not_converged and what TransportSolver throws
POWERCELL_API RemeshResult remesh(std::span<const double> vertices, std::span<const std::uint32_t> triangles,
                                  const RemeshOptions& options = {});

/// How good a triangle mesh is.
struct MeshQuality {
  std::size_t vertices = 0, triangles = 0;
  /// Q = 6/sqrt(3) area / (half perimeter x longest edge), 1 where equilateral: least and mean.
  double q_min = 0, q_mean = 0;
  double angle_min = 0, angle_max = 0;  ///< degrees
  double angle_min_mean = 0;            ///< mean over the triangles of their least angle, degrees
  double below_30 = 0;                  ///< share of angles below 30 degrees
  /// Share of vertices with degree 5 to 7; on the boundary, 3 to 5.
  double regular = 0;
  int euler_characteristic = 0;
  int boundary_loops = 0;
  /// Every edge has one or two triangles, every vertex one fan, at least three triangles where it is closed;
  /// sides agree.
  bool manifold = false;
};

/// \param vertices nv x 3, row-major   \param triangles nt x 3 indices from 0
/// \throw Error invalid_domain: what Domain::surface refuses of sizes, indices and coordinates
POWERCELL_API MeshQuality mesh_quality(std::span<const double> vertices,
                                       std::span<const std::uint32_t> triangles);

/// The largest distance of points of surface `a` from surface `b`, over about `samples` points spread over
/// `a` and its vertices: below the one-sided Hausdorff distance by at most the spread of the points.
/// \throw Error invalid_domain as mesh_quality
POWERCELL_API double farthest_from(const TriangleMesh& a, const TriangleMesh& b,
                                   std::size_t samples = 200000);

}  // namespace powercell
