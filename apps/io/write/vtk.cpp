#include <algorithm>
#include <cmath>

#include "apps/io/printable.hpp"
#include "apps/io/tables/kept_columns.hpp"
#include "apps/io/write/formats.hpp"
#include "apps/io/write/polygons.hpp"
#include "apps/io/write/vtk_file.hpp"
#include "apps/io/write/vtk_grid.hpp"

namespace powercell::io {
namespace {

constexpr std::uint8_t vtk_polygon = 7;
constexpr std::uint8_t vtk_polyhedron = 42;

double weight_of(const DiagramOutput& output, std::uint32_t seed) {
  return output.seeds.weights.empty() ? 0.0 : output.seeds.weights[seed];
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

/// Weight and measure of the cell that each element belongs to.
void write_figures(VtkFile& file, const DiagramOutput& output, const std::vector<std::uint32_t>& seeds) {
  std::vector<double> weight, measure;
  for (const std::uint32_t seed : seeds) {
    weight.push_back(weight_of(output, seed));
    measure.push_back(output.measures.mass[seed]);
  }
  file.array("weight", view(weight));
  file.array("measure", view(measure));
}

/// Of 64 bits where they are numbers among the seeds of several processes.
void write_seed_numbers(VtkFile& file, const DiagramOutput& output, const std::vector<std::uint32_t>& seeds) {
  if (!output.rows) {
    file.array("seed", view(seeds));
    return;
  }
  std::vector<std::int64_t> ids;
  for (const std::uint32_t seed : seeds) ids.push_back(static_cast<std::int64_t>(output.rows->id[seed]));
  file.array("seed", view(ids));
}

/// The columns of numbers of the seeds' table, for the seeds of the elements. Text is left out: not every
/// reader accepts arrays of strings.
void write_kept(VtkFile& file, const DiagramOutput& output, const std::vector<std::uint32_t>& seeds) {
  const KeptColumns kept(output.inputs, output.seeds,
                         {"seed", "region", "weight", "measure", "piece_measure", "neighbor", "facet"});
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
  const VtkGrid grid = output.whole_cells ? grid_of_cells(path, output) : grid_of_pieces(output);
  const bool polyhedra = grid.cell_dimension == 3;
  VtkFile file(path, "UnstructuredGrid");
  file.open("Piece",
            count("NumberOfPoints", grid.points.size() / 3) + " " + count("NumberOfCells", grid.seed.size()));
  write_points(file, grid.points);
  file.open("Cells");
  file.array("connectivity", view(grid.connectivity));
  file.array("offsets", view(grid.offsets));
  const std::vector<std::uint8_t> types(grid.seed.size(), polyhedra ? vtk_polyhedron : vtk_polygon);
  file.array("types", view(types));
  if (polyhedra) {
    file.array("faces", view(grid.faces));
    file.array("faceoffsets", view(grid.face_offsets));
  }
  file.close("Cells");
  file.open("CellData", "Scalars=\"seed\"");
  write_seed_numbers(file, output, grid.seed);
  if (!output.whole_cells) file.array("region", view(grid.region));
  write_figures(file, output, grid.seed);
  if (!output.whole_cells) file.array("piece_measure", view(grid.size));
  write_kept(file, output, grid.seed);
  file.close("CellData");
  file.close("Piece");
  file.finish();
}

void write_vtp(const std::string& path, const DiagramOutput& output) {
  const PolygonSoup soup = polygon_soup(output);
  std::vector<std::int64_t> connectivity(soup.corner.begin(), soup.corner.end());
  std::vector<std::int64_t> offsets(soup.offset.begin() + 1, soup.offset.end());
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
  write_figures(file, output, soup.seed);
  if (output.domain.cell_dimension() == 3) {
    file.array("neighbor", view(soup.neighbor));
    file.array("facet", view(soup.facet));
  }
  write_kept(file, output, soup.seed);
  file.close("CellData");
  file.close("Piece");
  file.finish();
}

}  // namespace powercell::io
