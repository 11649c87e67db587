/// \file
/// Domains: the polygon, surface or volume that a diagram is restricted to.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <powercell/error.hpp>
#include <span>
#include <vector>

namespace powercell {

struct RegionMesh;  // the domain cut into convex regions (library-internal)
struct RegionsView;

using Ring = std::vector<std::array<double, 2>>;  ///< a closed curve, the last point joined to the first

/// One part of a polygon: an outer ring and its holes. Each ring may have either orientation, collinear and
/// repeated points, and its first point again at the end.
struct PolygonPart {
  Ring outer;
  std::vector<Ring> holes;
};

enum class DomainKind { polygon, surface, volume };

/// An immutable, validated domain; copies share one state. Thread-safe. The largest absolute coordinate must
/// be from 1e-100 to 1e100 (else Error invalid_domain): beyond, measures leave the range of double.
class POWERCELL_API Domain {
 public:
  /// The union of parts with disjoint interiors. Rings and parts may touch in points, and parts along edges,
  /// which then are inside the domain. A ring must not touch itself. Boundary edges are numbered by part,
  /// ring and edge: outer rings counter-clockwise, holes clockwise, each from its first corner; a point where
  /// another ring touches an edge is a corner too. \throw Error invalid_domain (names the part and the place)
  static Domain polygon(std::span<const PolygonPart> parts);

  /// A triangle mesh in space: open, closed or non-manifold.
  /// \param vertices nv x 3, row-major   \param triangles nt x 3 indices from 0
  /// Vertices at the same position count as one. Triangles of zero area are left out: those whose least
  /// height is at most 2^-50 of their longest edge. \throw Error invalid_domain (names the triangle)
  static Domain surface(std::span<const double> vertices, std::span<const std::uint32_t> triangles);

  /// A tetrahedral mesh, each tetrahedron in either orientation.
  /// \param vertices nv x 3, row-major   \param tetrahedra nt x 4 indices from 0
  /// Vertices at the same position count as one. Flat tetrahedra are left out: those whose least height
  /// is at most 2^-50 of their longest edge. Two tetrahedra on the same side of a shared facet are
  /// an error; other overlaps are not detected and count twice.
  /// \throw Error invalid_domain (names the tetrahedron)
  static Domain volume(std::span<const double> vertices, std::span<const std::uint32_t> tetrahedra);

  /// The axis-aligned box from `low` to `high` (2 or 3 coordinates each). \throw Error invalid_domain
  static Domain box(std::span<const double> low, std::span<const double> high);

  DomainKind kind() const;
  int dimension() const;              ///< of the space: 2 or 3
  int cell_dimension() const;         ///< of the cells: 2 for polygon and surface, 3 for volume
  double measure() const;             ///< area or volume
  std::array<double, 3> low() const;  ///< bounding box (third coordinate 0 in 2D)
  std::array<double, 3> high() const;
  RegionsView regions() const;       ///< see powercell/regions.hpp
  std::size_t region_count() const;  ///< convex pieces, triangles or tetrahedra that were kept

  explicit Domain(std::shared_ptr<const RegionMesh> mesh) : mesh_(std::move(mesh)) {}
  /// For the library's own use.
  const RegionMesh& mesh() const { return *mesh_; }

 private:
  std::shared_ptr<const RegionMesh> mesh_;
};

}  // namespace powercell
