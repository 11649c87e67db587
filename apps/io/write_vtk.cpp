#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "apps/io/kept_columns.hpp"
#include "apps/io/printable.hpp"
#include "apps/io/write_formats.hpp"
#include "apps/io/write_polygons.hpp"
#include "apps/io/write_vtk_file.hpp"

namespace powercell::io {
namespace {

constexpr std::uint8_t vtk_polygon = 7;
constexpr std::uint8_t vtk_polyhedron = 42;

using SpacePoint = std::array<double, 3>;

SpacePoint vector_product(const SpacePoint& a, const SpacePoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double weight_of(const DiagramOutput& output, std::uint32_t seed) {
  return output.seeds.weights.empty() ? 0.0 : output.seeds.weights[seed];
}

// The pieces in VTK's arrays: connectivity and offsets, and for polyhedra the stream of faces.
struct Grid {
  std::vector<double> points;  // np x 3
  std::vector<std::int64_t> connectivity, offsets, faces, face_offsets;
  std::vector<std::uint32_t> seed, region;
  std::vector<double> weight, measure, piece_measure;

  SpacePoint point(std::uint64_t v) const { return {points[3 * v], points[3 * v + 1], points[3 * v + 2]}; }
  SpacePoint from(std::uint64_t v, const SpacePoint& o) const {
    const SpacePoint p = point(v);
    return {p[0] - o[0], p[1] - o[1], p[2] - o[2]};
  }
};

double polygon_area(const Grid& grid, std::uint64_t first, std::uint64_t end) {
  const SpacePoint o = grid.point(first);
  SpacePoint sum{};
  for (std::uint64_t v = first + 1; v + 1 < end; ++v) {
    const SpacePoint n = vector_product(grid.from(v, o), grid.from(v + 1, o));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += n[k];
  }
  return 0.5 * std::hypot(sum[0], sum[1], sum[2]);
}

double add_faces(Grid& grid, const Cells& cells, std::uint64_t piece) {
  const std::uint64_t first = cells.vertex_offset[piece];
  const SpacePoint o = grid.point(first);
  double six_volumes = 0;
  grid.faces.push_back(static_cast<std::int64_t>(cells.face_offset[piece + 1] - cells.face_offset[piece]));
  for (std::uint64_t f = cells.face_offset[piece]; f < cells.face_offset[piece + 1]; ++f) {
    const std::uint64_t begin = cells.loop_offset[f], end = cells.loop_offset[f + 1];
    grid.faces.push_back(static_cast<std::int64_t>(end - begin));
    for (std::uint64_t e = begin; e < end; ++e) {
      grid.faces.push_back(static_cast<std::int64_t>(first + cells.loop[e]));
    }
    for (std::uint64_t e = begin + 1; e + 1 < end; ++e) {
      const SpacePoint a = grid.from(first + cells.loop[begin], o);
      const SpacePoint n =
          vector_product(grid.from(first + cells.loop[e], o), grid.from(first + cells.loop[e + 1], o));
      six_volumes += a[0] * n[0] + a[1] * n[1] + a[2] * n[2];
    }
  }
  grid.face_offsets.push_back(static_cast<std::int64_t>(grid.faces.size()));
  return six_volumes / 6;
}

// Seeds and their pieces, in volumes sorted by the number of vertices: meshio groups polyhedra by that number
// and mixes up the data of the groups in any other order.
std::vector<std::pair<std::uint32_t, std::uint64_t>> ordered_pieces(const Cells& cells) {
  std::vector<std::pair<std::uint32_t, std::uint64_t>> order;
  order.reserve(cells.piece_count());
  for (std::size_t i = 0; i < cells.cell_count(); ++i) {
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p) {
      order.emplace_back(static_cast<std::uint32_t>(i), p);
    }
  }
  const auto vertices = [&](std::uint64_t p) { return cells.vertex_offset[p + 1] - cells.vertex_offset[p]; };
  if (cells.cell_dimension == 3) {
    std::stable_sort(order.begin(), order.end(),
                     [&](const auto& a, const auto& b) { return vertices(a.second) < vertices(b.second); });
  }
  return order;
}

Grid grid_of_pieces(const DiagramOutput& output) {
  const Cells& cells = output.cells;
  const auto d = static_cast<std::size_t>(cells.dimension);
  Grid grid;
  for (std::size_t v = 0; d > 0 && v + d <= cells.vertices.size(); v += d) {
    for (std::size_t k = 0; k < 3; ++k) grid.points.push_back(k < d ? cells.vertices[v + k] : 0.0);
  }
  for (const auto& [seed, p] : ordered_pieces(cells)) {
    for (std::uint64_t v = cells.vertex_offset[p]; v < cells.vertex_offset[p + 1]; ++v) {
      grid.connectivity.push_back(static_cast<std::int64_t>(v));
    }
    grid.offsets.push_back(static_cast<std::int64_t>(grid.connectivity.size()));
    grid.seed.push_back(seed);
    grid.region.push_back(cells.region[p]);
    grid.weight.push_back(weight_of(output, seed));
    grid.measure.push_back(output.measures.mass[seed]);
    grid.piece_measure.push_back(
        cells.cell_dimension == 3 ? add_faces(grid, cells, p)
                                  : polygon_area(grid, cells.vertex_offset[p], cells.vertex_offset[p + 1]));
  }
  return grid;
}

template <class T>
std::span<const T> view(const std::vector<T>& values) {
  return values;
}

std::string count(std::string_view what, std::size_t n) {
  std::string text(what);
  text += "=\"";
  text += std::to_string(n);
  return text += '"';
}

void write_points(VtkFile& file, const std::vector<double>& points) {
  file.open("Points");
  file.array("Points", view(points), 3);
  file.close("Points");
}

/// The columns of numbers of the seeds' table, for the seeds of the elements. Text is left out: not every
/// reader accepts arrays of strings.
void write_kept(VtkFile& file, const DiagramOutput& output, const std::vector<std::uint32_t>& seeds) {
  const KeptColumns kept(output.inputs, output.seeds,
                         {"seed", "region", "weight", "measure", "piece_measure", "neighbor"});
  for (const KeptColumn& column : kept.columns()) {
    const bool twice = kept.has_weights() && output.inputs.table->columns.weight == column.index;
    if (column.type == KeptColumn::Type::text || twice) continue;
    const std::vector<double> numbers = kept.numbers(column);
    std::vector<double> values;
    std::vector<std::int64_t> whole;
    const bool any_empty =
        std::any_of(numbers.begin(), numbers.end(), [](double v) { return std::isnan(v); });
    for (const std::uint32_t seed : seeds) {
      if (column.type == KeptColumn::Type::whole && !any_empty)
        whole.push_back(static_cast<std::int64_t>(numbers[seed]));
      else
        values.push_back(numbers[seed]);
    }
    const std::string name = xml_text(printable(column.name));
    if (values.empty())
      file.array(name, view(whole));
    else
      file.array(name, view(values));
  }
}

}  // namespace

void write_vtu(const std::string& path, const DiagramOutput& output) {
  const Grid grid = grid_of_pieces(output);
  const bool solid = output.cells.cell_dimension == 3;
  VtkFile file(path, "UnstructuredGrid");
  file.open("Piece",
            count("NumberOfPoints", grid.points.size() / 3) + " " + count("NumberOfCells", grid.seed.size()));
  write_points(file, grid.points);
  file.open("Cells");
  file.array("connectivity", view(grid.connectivity));
  file.array("offsets", view(grid.offsets));
  const std::vector<std::uint8_t> types(grid.seed.size(), solid ? vtk_polyhedron : vtk_polygon);
  file.array("types", view(types));
  if (solid) {
    file.array("faces", view(grid.faces));
    file.array("faceoffsets", view(grid.face_offsets));
  }
  file.close("Cells");
  file.open("CellData", "Scalars=\"seed\"");
  file.array("seed", view(grid.seed));
  file.array("region", view(grid.region));
  file.array("weight", view(grid.weight));
  file.array("measure", view(grid.measure));
  file.array("piece_measure", view(grid.piece_measure));
  write_kept(file, output, grid.seed);
  file.close("CellData");
  file.close("Piece");
  file.finish();
}

void write_vtp(const std::string& path, const DiagramOutput& output) {
  const PolygonSoup soup = polygon_soup(output);
  std::vector<std::int64_t> connectivity(soup.corner.begin(), soup.corner.end());
  std::vector<std::int64_t> offsets(soup.offset.begin() + 1, soup.offset.end());
  std::vector<double> weight, measure;
  for (const std::uint32_t seed : soup.seed) {
    weight.push_back(weight_of(output, seed));
    measure.push_back(output.measures.mass[seed]);
  }
  VtkFile file(path, "PolyData");
  file.open("Piece", count("NumberOfPoints", soup.vertex_count()) + " " +
                         count("NumberOfPolys", soup.size()) +
                         " NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\"");
  write_points(file, soup.vertices);
  file.open("Polys");
  file.array("connectivity", view(connectivity));
  file.array("offsets", view(offsets));
  file.close("Polys");
  file.open("CellData", "Scalars=\"seed\"");
  file.array("seed", view(soup.seed));
  file.array("weight", view(weight));
  file.array("measure", view(measure));
  if (output.domain.cell_dimension() == 3) file.array("neighbor", view(soup.neighbor));
  write_kept(file, output, soup.seed);
  file.close("CellData");
  file.close("Piece");
  file.finish();
}

}  // namespace powercell::io
