/// \file
/// The laws, one function each.
#pragma once

#include <powercell/verify.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lib/domain/random_points.hpp"
#include "lib/verify/rounding.hpp"

namespace powercell {

/// Keeps the finding that is worst relative to its tolerance.
class Worst {
 public:
  /// \param describe  gives the text that names the place; called only if this finding is the worst so far
  /// and
  ///   exceeds its tolerance
  template <class Describe>
  void see(double value, double allowed, const Describe& describe) {
    // NaN is a fault too, hence the negated comparisons.
    const double ratio = value == 0 ? 0 : allowed > 0 ? value / allowed : infinite;
    if (ratio <= ratio_) return;
    ratio_ = ratio > ratio_ ? ratio : infinite;
    value_ = value;
    allowed_ = allowed;
    if (!(value <= allowed)) detail_ = describe();
  }

  void see(const Worst& other) {
    if (other.ratio_ > ratio_) *this = other;
  }

  /// \param usual  the tolerance to report if nothing was measured
  LawCheck result(std::string law, double usual) const {
    const bool any = ratio_ > 0;
    return {std::move(law), !(ratio_ > 1), value_, any ? allowed_ : usual, detail_};
  }

 private:
  static constexpr double infinite = 1e300;
  double ratio_ = 0, value_ = 0, allowed_ = 0;
  std::string detail_;
};

/// The measures sum to the domain's.
/// \param mesh  of the domain, null where it is not known
LawCheck check_partition(const Measures& measures, const Cells& cells, const RegionMesh* mesh,
                         const Rounding& rounding);

/// A seed is ok exactly if it has a positive measure and a piece; hidden and duplicate seeds have neither. At
/// each position one seed is not a duplicate: that of the largest weight, then of the lowest index.
LawCheck check_statuses(const Measures& measures, const Cells& cells, const SeedsView& seeds);

/// Rows ascend, both sides of a wall are equal, and they differed little before they were averaged.
/// \param mesh  as in check_partition
LawCheck check_walls(const Adjacency& adjacency, const RegionMesh* mesh, const Rounding& rounding);

/// The pieces of each cell sum to its measure, and their centroid is its centroid. Pieces need not be convex.
std::vector<LawCheck> check_pieces(const Measures& measures, const Cells& cells, const Rounding& rounding);

/// The vertices of walls lie where two power distances are equal.
LawCheck check_bisectors(const Cells& cells, const Rounding& rounding);

/// Each face of a polygon or surface as a piece, each cell of a volume as one. Joining may leave nothing of a
/// cell as small as rounding, which then becomes a piece without faces.
Cells pieces_of(const JoinedCells& joined, const std::vector<SeedStatus>& status);

/// No other seed has a smaller power distance at a vertex of a cell; all seeds are tried at random vertices.
LawCheck check_vertices(const Cells& cells, const Rounding& rounding, const VerifyOptions& options);

/// Each sample lies in a piece of the seed of least power, found by trying all seeds.
LawCheck check_owners(const std::vector<Sample>& samples, const RegionMesh& mesh, const Cells& cells,
                      const Rounding& rounding);

/// The neighbours of seed i.
inline std::span<const std::uint32_t> row_of(const Adjacency& adjacency, std::size_t i) {
  return std::span(adjacency.neighbor)
      .subspan(adjacency.offset[i], adjacency.offset[i + 1] - adjacency.offset[i]);
}

/// Vertex v of the cells' array.
inline Vector cell_vertex(const Cells& cells, std::uint64_t v) {
  const double* x = &cells.vertices[v * static_cast<std::size_t>(cells.dimension)];
  return {x[0], x[1], cells.dimension == 3 ? x[2] : 0.0};
}
/// Corner k of face f: of a polyhedron's loop, or of the edge k of a polygon.
std::vector<Vector> face_corners(const Cells& cells, std::size_t piece, std::uint64_t face);
/// Twice the area vector of a flat polygon.
Vector twice_area(const std::vector<Vector>& corners);
/// Length of an edge, area of a face.
long double face_measure(const std::vector<Vector>& corners);

}  // namespace powercell
