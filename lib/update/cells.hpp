/// \file
/// The measures and walls of cells from the dual mesh. Internal.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lib/clip/host_clip.hpp"
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

/// Computes one cell after the other; each thread needs its own. A cell whose vertices are certainly within
/// the domain is computed from the centres of its simplices, any other one is clipped by its neighbours with
/// exact decisions.
template <int D>
class CellEvaluator {
 public:
  /// All must outlive the evaluator; it may be used again after the mesh has changed.
  CellEvaluator(const DualMesh<D>& mesh, const std::vector<Center>& centers, const ConvexBounds& bounds,
                const HostScene& scene)
      : mesh_(mesh), centers_(centers), bounds_(bounds), clipper_(HostClipper::make(scene, false)) {}

  /// \return whether the cell has points in the domain
  /// \throw MeshUnusable if the cell ties with the domain
  bool evaluate(std::uint32_t site);

  // Of the last cell, if it has points:
  std::span<const double> moments() const { return {moments_.data(), D + 2}; }  ///< as MomentSums::set
  std::span<const std::uint32_t> neighbors() const { return neighbors_; }
  std::span<const double> walls() const { return walls_; }  ///< the measure of that with each neighbour
  bool was_clipped() const { return was_clipped_; }

 private:
  struct Mark {
    std::uint32_t cell, place;
  };
  /// A vertex of the cell, relative to its site.
  struct Vertex {
    std::array<double, 3> at;
    std::uint32_t simplex;
  };
  /// A wall: twice the integrals of 1, three times x and twelve times |x|^2 over it, times its normal's length.
  struct Wall {
    std::uint32_t site, first;  ///< first: the vertex that its triangles share
    std::array<double, 3> normal;
    double sum, squares;
    std::array<double, 3> first_sums;
  };

  void start(std::uint32_t site);
  std::uint32_t vertex_of(std::uint32_t simplex);
  std::uint32_t wall_with(std::uint32_t other, std::uint32_t vertex);
  void visit(std::uint32_t vertex);
  void add_triangle(Wall& wall, const Vertex& from, const Vertex& to);
  bool is_inside() const;
  bool sum_walls();
  bool clip();

  const DualMesh<D>& mesh_;
  const std::vector<Center>& centers_;
  const ConvexBounds& bounds_;
  std::unique_ptr<HostClipper> clipper_;
  std::vector<Mark> simplex_mark_, site_mark_;
  std::uint32_t cell_ = 0;  // the number of the cell among all that were evaluated
  std::uint32_t site_ = 0;
  Site here_{};
  bool meets_frame_ = false;
  double reach_ = 0, error_ = 0;  // the largest distance of a vertex, squared, and error of one
  std::vector<Vertex> vertices_;
  std::vector<Wall> sums_;
  std::array<double, 5> moments_{};
  std::vector<std::uint32_t> neighbors_;
  std::vector<double> walls_;
  PieceBatch piece_;
  bool was_clipped_ = false;
};

extern template class CellEvaluator<2>;
extern template class CellEvaluator<3>;

}  // namespace powercell
