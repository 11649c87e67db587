/// \file
/// Domains: the polygon, surface or volume that a diagram is restricted to.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <powercell/error.hpp>
#include <span>
#include <string>
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

/// Two elements of a mesh, triangles or tetrahedra, that overlap.
struct Overlap {
  std::uint32_t first = 0, second = 0;  ///< indices of the input, ascending
  double measure = 0;                   ///< of their common part: an area or a volume
  std::array<double, 3> at{};           ///< the centroid of that part
};

/// The elements of a mesh that were left out, and those that overlap. Empty for polygons and boxes.
struct MeshReport {
  std::vector<std::uint32_t> flat;  ///< elements without area or volume, left out
  /// Elements with the same corners as an earlier one, left out: the index of each and of the earlier one. In
  /// the surface of a solid both are left out.
  std::vector<std::array<std::uint32_t, 2>> repeated;
  /// Pairs of the others that overlap by more than rounding (2^-50 of the largest coordinate). Their common
  /// part counts twice. Of each place that is covered more than once at least one pair is found.
  std::size_t overlaps = 0;
  double overlap = 0;  ///< the sum of the measures of their common parts
  Overlap largest;     ///< the pair with the largest common part

  bool empty() const { return flat.empty() && repeated.empty() && overlaps == 0; }
};

/// An immutable, validated domain; copies share one state. Thread-safe. The largest absolute coordinate must
/// be from 1e-100 to 1e100 (else Error invalid_domain): beyond, measures leave the range of double.
class POWERCELL_API Domain {
 public:
  /// The union of parts with disjoint interiors. Rings and parts may touch in points, and parts along edges,
  /// which then are inside the domain. A ring must not touch itself. Boundary edges are numbered by part,
  /// ring and edge: outer rings counter-clockwise, holes clockwise, each from its first corner; a point where
  /// another ring touches an edge is a corner too.
  /// \throw Error invalid_domain (names the part and the place)
  static Domain polygon(std::span<const PolygonPart> parts);

  /// A triangle mesh in space: open, closed or non-manifold.
  /// \param vertices nv x 3, row-major
  /// \param triangles nt x 3 indices from 0
  /// Vertices at the same position count as one. Triangles of zero area are left out: those whose least
  /// height is at most 2^-50 of their longest edge. Of triangles with the same corners, in any order, the
  /// first is kept. Triangles that overlap in a plane stay, and their common part counts twice; report()
  /// names them.
  /// \throw Error invalid_domain (names the triangle)
  static Domain surface(std::span<const double> vertices, std::span<const std::uint32_t> triangles);

  /// A tetrahedral mesh, each tetrahedron in either orientation.
  /// \param vertices nv x 3, row-major
  /// \param tetrahedra nt x 4 indices from 0
  /// Vertices at the same position count as one. Flat tetrahedra are left out: those whose least height
  /// is at most 2^-50 of their longest edge. Of tetrahedra with the same corners the first is kept.
  /// Tetrahedra that overlap are an error if they are on the same side of a facet that they share, or if
  /// overlaps add up to more than 10^-6 of the volume; smaller ones, as where parts with curved interfaces
  /// were meshed separately, stay and count twice, and report() names them.
  /// \throw Error invalid_domain (names the tetrahedra)
  static Domain volume(std::span<const double> vertices, std::span<const std::uint32_t> tetrahedra);

  /// The inside of a closed surface, without any tetrahedra: the points from which a ray crosses the surface
  /// an odd number of times. So shells in shells bound cavities and bodies in cavities in turn. The
  /// orientation of a shell does not matter.
  ///
  /// Vertices at the same position count as one. Triangles with two corners at one position are left out, and
  /// pairs of triangles with the same corners, as two bodies share them. The surface may touch itself in
  /// vertices and edges that triangles share.
  ///
  /// The geometry of cells in a solid is that of Diagram::joined(), without convex pieces: Diagram::cells()
  /// and all that needs it throws Error unsupported, as does single precision. regions() is empty.
  ///
  /// \param vertices   nv x 3, row-major
  /// \param triangles  nt x 3 indices from 0
  /// \throw Error  invalid_domain (names triangles and the place): an edge with an odd number of triangles,
  /// an
  ///               edge whose two triangles are oriented against each other, triangles that cross, overlap or
  ///               touch otherwise, corners in a line
  static Domain solid(std::span<const double> vertices, std::span<const std::uint32_t> triangles);

  /// The axis-aligned box from `low` to `high` (2 or 3 coordinates each).
  /// \throw Error invalid_domain
  static Domain box(std::span<const double> low, std::span<const double> high);

  /// A box whose opposite sides are identified along the axes where `periodic` is true; at least one. The
  /// others are bounded as in box(). Edges along periodic axes must not differ by more than a factor of 10^6.
  /// \throw Error invalid_domain, invalid_argument (sizes)
  static Domain periodic_box(std::span<const double> low, std::span<const double> high,
                             std::span<const bool> periodic);
  /// The same, periodic along all axes.
  static Domain periodic_box(std::span<const double> low, std::span<const double> high);

  /// The plane or space modulo the lattice of two vectors of two coordinates, or three of three, row-major,
  /// in any basis and orientation. regions() is the parallelogram or parallelepiped from `origin`, by default
  /// 0.
  /// \throw Error invalid_domain (dependent vectors; a reduced basis with lengths 10^6 times apart)
  static Domain lattice(std::span<const double> vectors, std::span<const double> origin = {});

  DomainKind kind() const;
  int dimension() const;       ///< of the space: 2 or 3
  int cell_dimension() const;  ///< of the cells: 2 for polygon and surface, 3 for volume
  double measure() const;      ///< area or volume
  bool is_periodic() const;    ///< along some axis
  /// The vectors of a lattice as given, or the edges of a periodic box along its periodic axes and 0 along
  /// the others: the units of Adjacency::shift. All 0 unless is_periodic().
  std::array<std::array<double, 3>, 3> periods() const;
  /// Points moved by whole periods into the domain, but for rounding: the positions that diagrams compute
  /// with. Images of one point are at the same position. Along bounded axes, and in other domains, as they
  /// are.
  /// \param positions  n x dimension(), row-major, finite
  /// \throw Error invalid_argument (size), invalid_seed (a point more than 2^28 periods outside)
  std::vector<double> wrapped(std::span<const double> positions) const;
  std::array<double, 3> low() const;  ///< bounding box (third coordinate 0 in 2D)
  std::array<double, 3> high() const;
  RegionsView regions() const;             ///< see powercell/regions.hpp
  std::size_t region_count() const;        ///< convex pieces, triangles or tetrahedra that were kept
  bool is_solid() const;                   ///< made by solid()
  const MeshReport& report() const;        ///< the elements of a mesh that were left out or overlap
  std::vector<std::string> notes() const;  ///< the same as sentences, one for each kind of fault

  explicit Domain(std::shared_ptr<const RegionMesh> mesh) : mesh_(std::move(mesh)) {}
  /// For the library's own use.
  const RegionMesh& mesh() const { return *mesh_; }

 private:
  std::shared_ptr<const RegionMesh> mesh_;
};

}  // namespace powercell
