#include <cmath>
#include <nlohmann/json.hpp>
#include <powercell/version.hpp>

#include "apps/io/atomic_file.hpp"
#include "apps/io/names.hpp"
#include "apps/io/write/formats.hpp"
#include "apps/io/write/shared_cells.hpp"

namespace powercell::io {
namespace {

// JSON has no infinities: they become null, as in every JavaScript engine.
void write_number(AtomicFile& file, double value) {
  if (std::isfinite(value))
    file.number(value);
  else
    file.write("null");
}

void write_point(AtomicFile& file, const double* point, std::size_t dimension) {
  file.write('[');
  for (std::size_t k = 0; k < dimension; ++k) {
    if (k > 0) file.write(',');
    write_number(file, point[k]);
  }
  file.write(']');
}

void write_border(AtomicFile& file, const Border& border) {
  if (border.kind == Border::Kind::interior) {
    file.write("null");
    return;
  }
  if (border.kind == Border::Kind::boundary) file.write('-');
  file.number(std::uint64_t{border.index} + (border.kind == Border::Kind::boundary ? 1u : 0u));
}

/// Writes the faces of cells, and numbers their points within each cell.
class GeometryWriter {
 public:
  GeometryWriter(AtomicFile& file, const DiagramOutput& output, const SharedCells& cells)
      : file_(file), dimension_(output.domain.dimension()), cells_(cells), place_(cells.point_count()) {}

  void write(std::size_t cell);

 private:
  void write_faces(std::size_t cell);
  void write_borders(std::size_t cell);
  void write_shifts(std::size_t cell);

  AtomicFile& file_;
  int dimension_;
  const SharedCells& cells_;
  std::vector<std::uint32_t> place_;  // of each point in the present cell
};

void GeometryWriter::write_faces(std::size_t cell) {
  for (std::uint64_t f = cells_.face_offset[cell]; f < cells_.face_offset[cell + 1]; ++f) {
    file_.write(f == cells_.face_offset[cell] ? "[" : ",[");
    const auto loop = cells_.face(f);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      if (k > 0) file_.write(',');
      file_.number(std::uint64_t{place_[loop[k]]});
    }
    file_.write(']');
  }
}

void GeometryWriter::write_borders(std::size_t cell) {
  for (std::uint64_t f = cells_.face_offset[cell]; f < cells_.face_offset[cell + 1]; ++f) {
    if (f > cells_.face_offset[cell]) file_.write(',');
    if (cells_.cell_dimension == 3) {
      write_border(file_, cells_.face_border[f]);
      continue;
    }
    file_.write('[');
    for (std::uint64_t e = cells_.loop_offset[f]; e < cells_.loop_offset[f + 1]; ++e) {
      if (e > cells_.loop_offset[f]) file_.write(',');
      write_border(file_, cells_.edge_border[e]);
    }
    file_.write(']');
  }
}

void write_shift(AtomicFile& file, const std::array<std::int32_t, 3>& shift, int dimension) {
  file.write('[');
  for (int k = 0; k < dimension; ++k) {
    if (k > 0) file.write(',');
    file.write(std::to_string(shift[static_cast<std::size_t>(k)]));
  }
  file.write(']');
}

/// Of a periodic domain: shifts parallel to the borders.
void GeometryWriter::write_shifts(std::size_t cell) {
  file_.write("],\"shifts\":[");
  for (std::uint64_t f = cells_.face_offset[cell]; f < cells_.face_offset[cell + 1]; ++f) {
    if (f > cells_.face_offset[cell]) file_.write(',');
    if (cells_.cell_dimension == 3) {
      write_shift(file_, cells_.shift[f], dimension_);
      continue;
    }
    file_.write('[');
    for (std::uint64_t e = cells_.loop_offset[f]; e < cells_.loop_offset[f + 1]; ++e) {
      if (e > cells_.loop_offset[f]) file_.write(',');
      write_shift(file_, cells_.shift[e], dimension_);
    }
    file_.write(']');
  }
}

void GeometryWriter::write(std::size_t cell) {
  const std::vector<std::uint32_t> points = cells_.points_of(cell);
  file_.write(",\"vertices\":[");
  for (std::size_t k = 0; k < points.size(); ++k) {
    place_[points[k]] = static_cast<std::uint32_t>(k);
    if (k > 0) file_.write(',');
    write_point(file_, cells_.point(points[k]), static_cast<std::size_t>(dimension_));
  }
  if (cells_.fault.empty()) {
    file_.write("],\"points\":[");
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (k > 0) file_.write(',');
      file_.number(std::uint64_t{points[k]});
    }
  }
  file_.write("],\"faces\":[");
  write_faces(cell);
  file_.write("],\"borders\":[");
  write_borders(cell);
  if (!cells_.shift.empty()) write_shifts(cell);
  file_.write(']');
}

void write_cell(AtomicFile& file, const DiagramOutput& output, GeometryWriter& geometry, std::size_t i) {
  const auto d = static_cast<std::size_t>(output.seeds.dimension);
  const Measures& measures = output.measures;
  file.write("{\"seed\":");
  file.number(std::uint64_t{i});
  file.write(",\"position\":");
  write_point(file, &output.seeds.positions[i * d], d);
  file.write(",\"weight\":");
  write_number(file, output.seeds.weights.empty() ? 0.0 : output.seeds.weights[i]);
  file.write(",\"status\":\"");
  file.write(name(measures.status[i]));
  file.write("\",\"measure\":");
  write_number(file, measures.mass[i]);
  file.write(",\"centroid\":");
  if (std::isfinite(measures.centroid[i * d]))
    write_point(file, &measures.centroid[i * d], d);
  else
    file.write("null");
  file.write(",\"second_moment\":");
  write_number(file, measures.second_moment[i]);
  geometry.write(i);
  file.write('}');
}

std::string json_string(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void write_head(AtomicFile& file, const DiagramOutput& output, const SharedCells& cells) {
  const Measures& measures = output.measures;
  file.write(std::string("{\"powercell\":\"") + version() + "\",\n\"domain\":{\"kind\":\"" +
             name(output.domain.kind()) + "\",\"dimension\":" + std::to_string(output.domain.dimension()) +
             ",\"measure\":");
  write_number(file, output.domain.measure());
  if (output.domain.is_periodic()) {
    const auto periods = output.domain.periods();
    const auto d = static_cast<std::size_t>(output.domain.dimension());
    file.write(",\"periods\":[");
    for (std::size_t k = 0; k < d; ++k) {
      if (k > 0) file.write(',');
      write_point(file, periods[k].data(), d);
    }
    file.write(']');
  }
  if (output.inputs.map && !output.inputs.map->crs.empty())
    file.write(",\"crs\":" + json_string(output.inputs.map->crs));
  if (const MapPlane* plane = output.inputs.plane())
    file.write(",\"projection\":" + json_string(plane->definition()));
  file.write("},\n\"check\":{\"cells\":" + std::to_string(measures.count(SeedStatus::ok)) +
             ",\"hidden\":" + std::to_string(measures.count(SeedStatus::hidden)) +
             ",\"duplicate\":" + std::to_string(measures.count(SeedStatus::duplicate)) + ",\"measure\":");
  write_number(file, measures.total());
  file.write(",\"domain_measure\":");
  write_number(file, measures.domain_measure);
  file.write(",\"relative_error\":");
  write_number(file, measures.relative_error());
  file.write("},\n\"points\":");
  if (cells.fault.empty())
    file.number(std::uint64_t{cells.point_count()});
  else
    file.write("null");
  file.write(
      ",\n\"borders\":\"j >= 0: the cell of seed j; -1-f: facet f of the domain's boundary; null: the same "
      "cell"
      " goes on\",\n\"cells\":[\n");
}

}  // namespace

void write_json(const std::string& path, const DiagramOutput& output) {
  SharedCells cells = share_cells(output);
  if (!cells.fault.empty()) cells = separate_cells(output, cells.fault);
  AtomicFile file(path);
  write_head(file, output, cells);
  GeometryWriter geometry(file, output, cells);
  for (std::size_t i = 0; i < output.seeds.size(); ++i) {
    if (i > 0) file.write(",\n");
    write_cell(file, output, geometry, i);
  }
  file.write("\n]}\n");
  file.commit();
}

}  // namespace powercell::io
