/// \file
/// The faces of each cell as loops of its vertices, kept from one diagram to the next. Internal.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/update/mesh.hpp"

namespace powercell {

/// The vertices of a cell are the simplices at its site, its faces the other corners of these. In the plane
/// face k goes from vertex k to the next one, counter-clockwise. In space a face is a loop of vertices,
/// counter-clockwise seen from outside.
struct CellGraph {
  std::span<const std::uint32_t> vertices;   ///< simplices
  std::span<const std::uint32_t> neighbors;  ///< per face: a site, or one of the frame
  std::span<const std::uint8_t> loop_size;   ///< per face (in space)
  std::span<const std::uint8_t> loop;        ///< the loops, one after the other: indices of `vertices`
};

/// The graphs of a range of sites; each thread has its own.
template <int D>
class CellGraphs {
 public:
  CellGraphs(const DualMesh<D>& mesh, std::uint32_t first, std::uint32_t end)
      : mesh_(mesh), first_(first), row_(end - first, none) {}

  /// The graph of a site that has a simplex, made anew if `changed`. Empty if the cell has too many vertices.
  CellGraph graph(std::uint32_t site, bool changed);
  /// After graph() was empty: the neighbours in the mesh.
  std::span<const std::uint32_t> neighbors() const { return faces_; }

 private:
  struct Mark {
    std::uint32_t cell, place;
  };
  static constexpr std::uint64_t none = ~std::uint64_t{0};
  static constexpr std::size_t most_vertices = 255;
  static std::size_t words(std::size_t vertices, std::size_t faces) {
    return 2 + vertices + faces + (D == 3 ? (faces + 3) / 4 + (3 * vertices + 3) / 4 : 0);
  }

  CellGraph at(std::uint64_t row) const;
  void make(std::uint32_t site);
  bool find_star(std::uint32_t site);
  std::uint32_t place_of(std::vector<Mark>& marks, std::uint32_t what, std::vector<std::uint32_t>& list);
  void write_row(std::uint32_t site);
  void write_loops(std::uint8_t* sizes, std::uint8_t* loop);
  void compact();

  const DualMesh<D>& mesh_;
  std::uint32_t first_;
  std::vector<std::uint64_t> row_;    // per site: the place of its row in words_
  std::vector<std::uint32_t> words_;  // per row: vertices, faces, and the arrays of CellGraph
  std::size_t unused_ = 0;            // words of rows that were replaced
  // Scratch memory of make().
  std::vector<Mark> simplex_mark_, site_mark_;
  std::uint32_t cell_ = 0;
  std::vector<std::uint32_t> simplices_, faces_;
  std::vector<std::array<std::uint8_t, 3>> face_,
      next_;  // per vertex: three faces, and the vertex after it on each
};

extern template class CellGraphs<2>;
extern template class CellGraphs<3>;

}  // namespace powercell
