#include "apps/io/write/polygons.hpp"

namespace powercell::io {
namespace {

void append_vertices(PolygonSoup& soup, const std::vector<double>& from, int dimension) {
  const auto d = static_cast<std::size_t>(dimension);
  if (d == 0) return;
  soup.vertices.reserve(from.size() / d * 3);
  for (std::size_t v = 0; v + d <= from.size(); v += d) {
    for (std::size_t k = 0; k < 3; ++k) soup.vertices.push_back(k < d ? from[v + k] : 0.0);
  }
}

PolygonSoup soup_of_pieces(const Cells& cells) {
  PolygonSoup soup;
  append_vertices(soup, cells.vertices, cells.dimension);
  soup.offset.push_back(0);
  for (std::size_t i = 0; i < cells.cell_count(); ++i) {
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p) {
      for (std::uint64_t v = cells.vertex_offset[p]; v < cells.vertex_offset[p + 1]; ++v) {
        soup.corner.push_back(v);
      }
      soup.offset.push_back(soup.corner.size());
      soup.seed.push_back(static_cast<std::uint32_t>(i));
      soup.neighbor.push_back(-1);
      soup.facet.push_back(-1);
    }
  }
  return soup;
}

PolygonSoup soup_of_faces(const JoinedCells& cells) {
  PolygonSoup soup;
  append_vertices(soup, cells.vertices, cells.dimension);
  soup.offset.push_back(0);
  for (std::size_t i = 0; i + 1 < cells.face_offset.size(); ++i) {
    for (std::uint64_t f = cells.face_offset[i]; f < cells.face_offset[i + 1]; ++f) {
      for (std::uint64_t e = cells.loop_offset[f]; e < cells.loop_offset[f + 1]; ++e) {
        soup.corner.push_back(cells.vertex_offset[i] + cells.loop[e]);
      }
      soup.offset.push_back(soup.corner.size());
      soup.seed.push_back(static_cast<std::uint32_t>(i));
      const Border& border = cells.face_border[f];
      soup.neighbor.push_back(border.kind == Border::Kind::wall ? std::int64_t{border.index} : -1);
      soup.facet.push_back(border.kind == Border::Kind::boundary ? std::int64_t{border.index} : -1);
    }
  }
  return soup;
}

}  // namespace

PolygonSoup polygon_soup(const DiagramOutput& output) {
  return output.domain.cell_dimension() == 3 ? soup_of_faces(output.joined) : soup_of_pieces(output.cells);
}

}  // namespace powercell::io
