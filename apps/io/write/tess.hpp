/// \file
/// A diagram as neper's tessellation: numbered edges and faces, and the parts of the domain that they lie on.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/io/write/shared_cells.hpp"

namespace powercell::io {

using TessEdge = std::pair<std::uint32_t, std::uint32_t>;  ///< its points, the lower one first

/// Everything is numbered from 0; in the file it is from 1.
struct Tess {
  SharedCells cells;
  std::vector<std::uint32_t> seed;  ///< per cell: cells without extent are left out
  std::vector<std::uint64_t> face;  ///< per face: its number in `cells`; a wall once
  std::vector<TessEdge> edges;
  std::map<TessEdge, std::uint32_t> edge_number;
};

/// A part of the domain and the parts of the tessellation in it.
struct TessDomainVertex {
  std::uint32_t point;
  std::string label;
};
struct TessDomainEdge {
  std::vector<std::uint32_t> vertices, edges;  ///< two domain vertices; edges of the tessellation
  std::string label;
};
struct TessDomainFace {
  std::vector<std::uint32_t> vertices, edges;  ///< domain vertices and edges around it
  std::array<double, 4> plane{};               ///< d a b c with a x + b y + c z = d, the normal inwards
  std::string label;
  std::vector<std::uint32_t> faces;  ///< of the tessellation
};
struct TessDomain {
  bool box = false;  ///< with neper's names: x0, x1, y0 and so on
  std::vector<TessDomainVertex> vertices;
  std::vector<TessDomainEdge> edges;
  std::vector<TessDomainFace> faces;  ///< none in the plane
};

/// \throw Error write_failed if the boundary is not made of simple polygons, or, in the plane, of edges with
/// two ends
TessDomain domain_of(const std::string& path, const DiagramOutput& output, const Tess& tess);

/// d a b c of the plane of a polygon, counter-clockwise seen from where a, b, c points.
std::array<double, 4> plane_of(const SharedCells& cells, std::span<const std::uint32_t> loop);

}  // namespace powercell::io
