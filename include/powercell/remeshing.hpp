/// \file
/// Remeshing: a new triangle mesh of a surface with a given number of vertices, well-shaped triangles, and
/// edges that are shorter where the curvature is larger.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <powercell/device.hpp>
#include <powercell/error.hpp>
#include <powercell/repair.hpp>
#include <powercell/shapes.hpp>
#include <span>
#include <vector>

namespace powercell {

enum class RemeshMethod {
  /// Removes each point in turn and reinserts it where it is farthest from the others (Yan, Guo, Zhang, Wonka
  /// 2014; weights by curvature as in Xiao, Cao, Xu, Chen 2023), updating the restricted power diagram
  /// locally. On the host, in one thread.
  farthest_point,
  /// Moves the points to the centroids of cells of equal mass for the density h^-2 (see transport.hpp).
  transport,
};

struct RemeshOptions {
  RemeshMethod method = RemeshMethod::farthest_point;
  std::size_t count = 5000;       ///< number of vertices of the new mesh, met exactly; at least 4
  double gradation = 0.2;         ///< limit on the gradient of the edge length h over the surface; (0, 10]
  double contrast = 4;            ///< limit on the ratio of two target edge lengths, 1 to 1000; 1: uniform
  double sharp_angle = 45;        ///< degrees, (0, 180]; edges with a larger angle between normals are kept
  int rounds = 20;                ///< limit on rounds of the method, which stops earlier when the points rest
  int relaxations = 15;           ///< rounds of the final relaxation; 0: the dual, only brought to `count`
  std::uint64_t random_seed = 1;  ///< the same seed gives the same mesh
  bool repair = true;             ///< by repair(); else edges are joined by their vertices' indices alone
  /// Device for the method transport; Device::choose() if empty.
  std::optional<Device> device;
  /// Called with the fraction done, which never decreases, several times a second for meshes of up to 10^5
  /// triangles; returning false stops with Error interrupted.
  std::function<bool(double)> progress;
};

/// The new mesh. Arrays are owned.
struct RemeshResult {
  TriangleMesh mesh;                  ///< each component is oriented as its first input triangle
  RepairReport repair;                ///< what was done to the input and what was left, see repair()
  std::vector<bool> fixed;            ///< per vertex: on a boundary, a sharp edge or a corner
  std::vector<double> sizing;         ///< per vertex: the target edge length h
  std::vector<double> least_spacing;  ///< after each round: least distance between neighbours, over h
  std::size_t added = 0;              ///< points beyond `count` that the dual needed; later collapsed
  /// Whether the mesh was made by collapsing edges of the input instead of as the dual of cells: the points
  /// are too few for a dual of the topology of the surface, as where it is thin or crosses itself.
  bool collapsed = false;
  std::optional<std::array<double, 3>> inseparable;  ///< if collapsed for that reason, a place of it
  RepairCount intersections;  ///< pairs of triangles of the new mesh that cross each other
  double seconds_sample = 0, seconds_dual = 0, seconds_relax = 0;  ///< wall-clock times of the stages
};

/// Remeshes a surface: spreads points over it, takes the dual of their restricted power cells and relaxes it.
///
/// The input is a triangle mesh, open or closed; it is repaired first. The vertices of the new mesh lie on
/// it. The new mesh is a manifold with the same Euler characteristic and number of boundary loops; its edges
/// and vertices reproduce the boundaries, the edges sharper than `sharp_angle` and their corners. Where parts
/// of the surface are closer to each other than the new mesh is to them, its triangles may cross.
/// \param vertices   nv x 3, row-major
/// \param triangles  nt x 3 vertex indices from 0
/// \throw Error invalid_domain (sizes, indices and coordinates that Domain::surface refuses; a surface that
///   cannot be oriented, or is so thin that cutting its triangles to the new spacing would make more than
///   10^5, out of proportion to the result; a triangle without area that repair() left; without repair: any
///   such triangle, an edge of more than two triangles, a vertex where sheets touch)
/// \throw Error invalid_argument (an option out of range; too few points for the topology or the kept edges)
/// \throw Error interrupted; for the method transport not_converged, and as TransportSolver
POWERCELL_API RemeshResult remesh(std::span<const double> vertices, std::span<const std::uint32_t> triangles,
                                  const RemeshOptions& options = {});

/// Quality of a triangle mesh.
struct MeshQuality {
  std::size_t vertices = 0, triangles = 0;  ///< vertices that triangles use
  /// Least and mean of Q = 6/sqrt(3) area / (half perimeter x longest edge), which is 1 if equilateral.
  double q_min = 0, q_mean = 0;
  double angle_min = 0, angle_max = 0;  ///< degrees
  double angle_min_mean = 0;            ///< mean over the triangles of the smallest angle, degrees
  double below_30 = 0;                  ///< share of angles below 30 degrees
  /// Share of vertices with degree 5 to 7, or 3 to 5 on the boundary.
  double regular = 0;
  int euler_characteristic = 0;
  int boundary_loops = 0;
  /// Consistently oriented; every edge has one or two triangles; the triangles of every vertex form one fan,
  /// with at least three triangles if closed.
  bool manifold = false;
};

/// Measures the quality of a triangle mesh.
/// \param vertices   nv x 3, row-major
/// \param triangles  nt x 3 vertex indices from 0
/// \throw Error invalid_domain (sizes, indices and coordinates that Domain::surface refuses)
POWERCELL_API MeshQuality mesh_quality(std::span<const double> vertices,
                                       std::span<const std::uint32_t> triangles);

/// The largest distance from surface `b` of the vertices of surface `a` and about `samples` points spread
/// over it: a lower bound of the one-sided Hausdorff distance, short by at most the spacing of the points.
/// \throw Error invalid_domain, as mesh_quality
POWERCELL_API double farthest_from(const TriangleMesh& a, const TriangleMesh& b,
                                   std::size_t samples = 200000);

}  // namespace powercell
