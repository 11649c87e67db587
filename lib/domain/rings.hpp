/// \file
/// The rings of a polygon, cleaned, as indices of distinct vertices.
#pragma once

#include <array>
#include <cstdint>
#include <powercell/domain.hpp>
#include <span>
#include <string>
#include <vector>

namespace powercell {

/// Outer rings counter-clockwise, holes clockwise: the domain is on the left of every edge.
struct IndexedRing {
  std::uint32_t part = 0;
  std::uint32_t hole = 0;  ///< 0: the outer ring; k: hole k - 1
  std::vector<std::uint32_t> vertex;
};

struct IndexedRings {
  std::vector<double> vertices;    ///< nv x 2, distinct, in lexicographic order
  std::vector<IndexedRing> rings;  ///< by part, the outer ring before its holes
  std::uint32_t parts = 0;

  const double* at(std::uint32_t v) const { return &vertices[2 * std::size_t{v}]; }
  /// The rings [first, last).
  std::span<const IndexedRing> part(std::size_t first, std::size_t last) const {
    return std::span(rings).subspan(first, last - first);
  }
  /// The vertex at (x, y), or the number of vertices if there is none.
  std::uint32_t find(double x, double y) const;
  std::size_t vertex_count() const { return vertices.size() / 2; }
};

/// "(0.25, 1e-06)", with all digits of both.
std::string place(double x, double y);

/// "part 2, hole 0"
std::string ring_name(std::uint32_t part, std::uint32_t hole);

/// Removes repeated points and points inside straight edges, orients the rings, and indexes their vertices.
/// \throw Error invalid_domain: no parts, a coordinate that is not finite, a ring without area
IndexedRings index_rings(std::span<const PolygonPart> parts);

}  // namespace powercell
