/// \file
/// The results of a diagram. The structs own their arrays; seeds keep the caller's order.
#pragma once

#include <array>
#include <cstdint>
#include <powercell/export.hpp>
#include <vector>

namespace powercell {

enum class SeedStatus : std::uint8_t {
  ok,         ///< the cell has a positive measure
  hidden,     ///< the cell restricted to the domain is empty
  duplicate,  ///< another seed at the same position has a larger weight, or the same and a lower index
};

/// Integrals over each cell (density 1). n seeds, d coordinates.
struct POWERCELL_API Measures {
  int dimension = 0;                  ///< d
  std::vector<double> mass;           ///< n: area or volume of the cell; 0 where empty
  std::vector<double> centroid;       ///< n x d, row-major; NaN where the cell is empty
  std::vector<double> second_moment;  ///< n: integral of |x - p_i|^2 over the cell
  std::vector<SeedStatus> status;     ///< n
  double domain_measure = 0;

  double total() const;           ///< sum of the masses, compensated
  double relative_error() const;  ///< |total() - domain_measure| / domain_measure
  std::size_t count(SeedStatus s) const;
};

/// The pairs of cells that share a wall inside the domain, as compressed sparse rows. Symmetric: j is in row
/// i with the same wall measure as i in row j, with the opposite shift.
struct Adjacency {
  std::vector<std::uint64_t> offset;    ///< n + 1; row i is [offset[i], offset[i+1])
  std::vector<std::uint32_t> neighbor;  ///< ascending within a row
  std::vector<double> wall;             ///< length (polygon, surface) or area (volume) of the wall
  /// In a periodic domain (else empty), per entry: the image of the neighbour, in periods of the domain
  /// (Domain::periods). The wall is with the neighbour as given, moved by the sum of shift[k] times period k.
  /// A seed may occur several times in a row, with ascending shifts, and so may the row's own seed.
  std::vector<std::array<std::int32_t, 3>> shift;
  double asymmetry = 0;                       ///< largest |a_ij - a_ji| before the two sides were averaged
  std::array<std::uint32_t, 2> asymmetric{};  ///< i and j of that difference; equal if there was none
};

/// The parts of the domain's boundary that belong to each cell, as compressed sparse rows. Facets have the
/// numbers of RegionsView::facet and of Border::boundary; in a box of space these are -x +x -y
/// +y -z +z, in one of the plane -y +x +y -x.
struct BoundaryWalls {
  std::vector<std::uint64_t> offset;  ///< n + 1; row i is [offset[i], offset[i+1])
  std::vector<std::uint32_t> facet;   ///< ascending within a row
  std::vector<double> measure;        ///< length (polygon, surface) or area (volume) of the part
};

/// The other side of a face of a cell.
struct Border {
  enum class Kind : std::uint32_t {
    wall,      ///< the cell of seed `index`
    boundary,  ///< the outside: facet `index` of the domain's boundary
    interior,  ///< the same cell, in region `index` of the domain
  };
  Kind kind;
  std::uint32_t index;
  friend bool operator==(const Border&, const Border&) = default;
};

/// The geometry of the cells as convex pieces, one for each region of the domain that a cell meets.
/// A piece without thickness in a facet between regions is kept, since it carries a wall; it adds nothing to
/// the measures. Where seeds tie, faces and edges may have no extent. Cell i owns the pieces [cell_offset[i],
/// cell_offset[i+1]). Piece p has the vertices [vertex_offset[p], vertex_offset[p+1]) and the faces
/// [face_offset[p], face_offset[p+1]). For polygons and surfaces a face is an edge: face k of a piece
/// goes from its vertex k to its vertex k+1 (cyclic), counter-clockwise (on a surface, as the
/// triangle is oriented), and `loop_offset` and `loop` are empty. For volumes face f is the polygon
/// loop[loop_offset[f] .. loop_offset[f+1]), indices from 0 within the piece's vertices,
/// counter-clockwise seen from outside. For example, the vertices of cell i:
///
///     for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p)
///       for (std::uint64_t v = cells.vertex_offset[p]; v < cells.vertex_offset[p + 1]; ++v)
///         use(&cells.vertices[v * cells.dimension]);
struct POWERCELL_API Cells {
  int dimension = 0;                         ///< d, coordinates of a vertex
  int cell_dimension = 0;                    ///< 2 or 3
  std::vector<std::uint64_t> cell_offset;    ///< n + 1
  std::vector<std::uint32_t> region;         ///< per piece: the region of the domain it lies in
  std::vector<std::uint64_t> vertex_offset;  ///< pieces + 1
  std::vector<double> vertices;              ///< row-major, d per vertex
  std::vector<std::uint64_t> face_offset;    ///< pieces + 1
  std::vector<Border> border;                ///< per face
  std::vector<std::array<std::int32_t, 3>>
      shift;                               ///< per face in a periodic domain: as in Adjacency; else empty
  std::vector<std::uint64_t> loop_offset;  ///< faces + 1 (volumes only)
  std::vector<std::uint32_t> loop;

  std::size_t cell_count() const { return cell_offset.empty() ? 0 : cell_offset.size() - 1; }
  std::size_t piece_count() const { return region.size(); }
};

/// Cells joined across the regions of the domain: the faces of a cell share vertices, and the faces between
/// its pieces are removed. Cell i owns the vertices [vertex_offset[i], vertex_offset[i+1]) and the faces
/// [face_offset[i], face_offset[i+1]); face f is loop[loop_offset[f] .. loop_offset[f+1]), indices
/// from 0 within the cell's vertices.
/// Polygon: the faces of a cell are its boundary rings, outer ones counter-clockwise, holes
/// clockwise, and `edge_border` is the border of the edge that starts at each loop entry.
/// Surface: a face is a polygon in one triangle of the domain; `edge_border` as for polygons.
/// Volume: a face is a polygon on the cell's boundary, counter-clockwise seen from outside, and `face_border`
/// its border. A polygon has no holes: a wall that has some, or several parts, is several faces with the same
/// border.
/// Solid: as volume, but each face is convex (up to rounding, and to spikes without width where seeds tie
/// with the surface), so that a wall that is not is several faces; a boundary facet is a triangle of the
/// surface as given to Domain::solid without those left out, and of a cell each edge occurs as often in one
/// direction as in the other.
struct JoinedCells {
  int dimension = 0;
  int cell_dimension = 0;
  std::vector<std::uint64_t> vertex_offset;  ///< n + 1
  std::vector<double> vertices;
  std::vector<std::uint64_t> face_offset;  ///< n + 1
  std::vector<Border> face_border;         ///< per face (volumes only)
  std::vector<std::uint64_t> loop_offset;  ///< faces + 1
  std::vector<std::uint32_t> loop;
  std::vector<Border> edge_border;  ///< per loop entry (polygons and surfaces only)
  /// Per entry of face_border (volumes) or edge_border in a periodic domain: as in Adjacency; else empty.
  std::vector<std::array<std::int32_t, 3>> shift;
};

/// The regular triangulation restricted to the domain: one simplex for each point of the domain in which d+1
/// cells meet (three on polygons and surfaces, four in volumes). With exact decisions no more than d+1 cells
/// meet in a point: the order of the positions breaks ties, so that the simplices form a triangulation for
/// any seeds (in a solid a point exactly on the surface counts or not by the same order). All corners have
/// cells: a seed whose cell only touches the domain from outside is hidden, and not a corner.
struct Dual {
  int corners = 0;                       ///< 3 or 4
  std::vector<std::uint32_t> simplices;  ///< rows of `corners` seed indices, positively oriented
                                         ///< (surface: as the triangle it was found in), rows ascending
  /// Per entry of `simplices` in a periodic domain (else empty): the image of the seed, as in Adjacency. Of
  /// the simplices that translations make of one another there is one, whose first corner has the shift 0; it
  /// is positively oriented, or flat to rounding.
  std::vector<std::array<std::int32_t, 3>> shift;
  std::size_t size() const { return corners ? simplices.size() / static_cast<std::size_t>(corners) : 0; }
};

/// Seconds spent in each part of the last computation, and counts.
struct Timings {
  double total = 0;              ///< seeds in host memory to results in host memory, kernels built before
  double prepare = 0;            ///< validation, duplicates, ordering, tree
  double pairs = 0;              ///< which seeds meet which regions
  double neighbors = 0;          ///< neighbour lists on the host (FLANN)
  double clip = 0;               ///< kernels
  double collect = 0;            ///< results on the host
  double certify = 0;            ///< checking laws (Options::certify)
  double build = 0;              ///< compiling kernels (not in total)
  std::uint64_t pair_count = 0;  ///< candidate (region, seed) pairs
  std::uint64_t retried = 0;     ///< pairs that needed a larger capacity
  std::uint64_t on_host = 0;     ///< pairs that ended on the host
  std::uint64_t uncertain = 0;   ///< pairs in which rounding may have decided
  int rounds = 0;                ///< rounds of neighbour lists (FLANN)
};

}  // namespace powercell
