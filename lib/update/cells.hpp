/// \file
/// The measures and walls of cells from the dual mesh. Internal.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lib/base/vectors.hpp"
#include "lib/clip/host_clip.hpp"
#include "lib/update/cell_graphs.hpp"
#include "lib/update/centers.hpp"

namespace powercell {

/// A domain of one convex region: points with normal.x <= offset for all of its facets, in device units.
struct ConvexBounds {
  struct Plane {
    std::array<double, 3> normal;  ///< of length 1, or 0 where rounding leaves none
    double offset;
  };
  std::vector<Plane> planes;
  double size = 0;  ///< at least that of all coordinates in it

  explicit ConvexBounds(const HostScene& scene);
};

/// Integrals over a wall from the triangles that one of its points makes with its edges: twice that of 1, six
/// times that of x and 24 times that of |x|^2 (in the plane, of lengths: once, twice and three times), each
/// times the length of the normal.
struct WallSums {
  double one = 0, square = 0;
  Vector3<double> x{};

  void add_triangle(const Vector3<double>& top, const Vector3<double>& a, const Vector3<double>& b,
                    const Vector3<double>& normal) {
    const Vector3<double> s = top + a + b;
    const double part = dot(cross(a - top, b - top), normal);
    one += part;
    square += part * (dot(top, top) + dot(a, a) + dot(b, b) + dot(s, s));
    x = x + part * s;
  }
  void add_edge(const Vector3<double>& a, const Vector3<double>& b, const Vector3<double>& normal) {
    const double part = normal[0] * (b[1] - a[1]) - normal[1] * (b[0] - a[0]);
    one += part;
    square += part * (dot(a, a) + dot(b, b) + dot(a, b));
    x = x + part * (a + b);
  }
};

/// Computes one cell after the other, of a range of sites; each thread needs its own. A cell that certainly
/// lies within the domain, or is cut by one facet of it, is computed from the centres of its simplices; any
/// other one is clipped by its neighbours with exact decisions.
template <int D>
class CellEvaluator {
 public:
  /// All must outlive the evaluator; it may be used again after the mesh has changed.
  CellEvaluator(const DualMesh<D>& mesh, const std::vector<Center>& centers, const ConvexBounds& bounds,
                const HostScene& scene, std::uint32_t first, std::uint32_t end)
      : mesh_(mesh),
        centers_(centers),
        bounds_(bounds),
        graphs_(mesh, first, end),
        clipper_(HostClipper::make(scene, false)) {}

  /// \return whether the cell has points in the domain
  /// \throw MeshUnusable if the cell ties with the domain
  bool evaluate(std::uint32_t site);

  // Of the last cell, if it has points:
  std::span<const double> moments() const { return {moments_.data(), D + 2}; }  ///< as MomentSums::set
  std::span<const std::uint32_t> neighbors() const { return neighbors_; }
  std::span<const double> walls() const { return walls_; }  ///< the measure of that with each neighbour
  bool was_clipped() const { return was_clipped_; }

 private:
  enum class Place { inside, cut, outside, unclear };

  void find_vertices(const CellGraph& graph);
  Place find_place();
  Place side_of(const ConvexBounds::Plane& plane, double room);
  bool is_plain() const { return moments_[0] > least_measure(); }
  double least_measure() const;
  void add_wall(std::uint32_t neighbor, const WallSums& sums);
  void add_cone(double level, const WallSums& sums);
  bool sum_inside(const CellGraph& graph);
  bool sum_cut(const CellGraph& graph);
  bool cut_loop(const CellGraph& graph, std::size_t face, const std::uint8_t* loop, WallSums& sums);
  bool cross_edge(std::size_t face, std::uint8_t from, std::uint8_t to, Vector3<double>& point) const;
  void find_faces_of_vertices(const CellGraph& graph);
  Vector3<double> normal_of(std::uint32_t neighbor) const;
  /// The bisector is normal.x = level |normal|^2.
  double level_of(std::uint32_t neighbor, const Vector3<double>& normal) const;
  bool clip(std::span<const std::uint32_t> neighbors);

  const DualMesh<D>& mesh_;
  const std::vector<Center>& centers_;
  const ConvexBounds& bounds_;
  CellGraphs<D> graphs_;
  std::unique_ptr<HostClipper> clipper_;
  std::uint32_t site_ = 0;
  Site here_{};
  double reach_ = 0, error_ = 0;           // the largest distance of a vertex, and error of one
  std::vector<Vector3<double>> vertices_;  // relative to the site
  // Of a cell that a facet cuts: its plane, the sides of the vertices and their faces, and what is cut off.
  ConvexBounds::Plane facet_{};
  double room_ = 0;
  std::vector<std::uint8_t> outside_;
  std::vector<std::array<std::uint8_t, 4>> faces_of_;  // per vertex: their number, and three faces
  std::vector<Vector3<double>> normals_;
  std::vector<double> offsets_;
  bool has_cap_ = false;
  Vector3<double> cap_top_{};
  WallSums cap_;
  // Results.
  std::array<double, 5> moments_{};
  std::vector<std::uint32_t> neighbors_;
  std::vector<double> walls_;
  PieceBatch piece_;
  bool was_clipped_ = false;
};

extern template class CellEvaluator<2>;
extern template class CellEvaluator<3>;

}  // namespace powercell
