#include <cmath>
#include <nlohmann/json.hpp>
#include <powercell/version.hpp>

#include "apps/io/atomic_file.hpp"
#include "apps/io/names.hpp"
#include "apps/io/write_formats.hpp"

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

void write_faces(AtomicFile& file, const JoinedCells& joined, std::size_t cell) {
  for (std::uint64_t f = joined.face_offset[cell]; f < joined.face_offset[cell + 1]; ++f) {
    file.write(f == joined.face_offset[cell] ? "[" : ",[");
    for (std::uint64_t e = joined.loop_offset[f]; e < joined.loop_offset[f + 1]; ++e) {
      if (e > joined.loop_offset[f]) file.write(',');
      file.number(std::uint64_t{joined.loop[e]});
    }
    file.write(']');
  }
}

void write_borders(AtomicFile& file, const JoinedCells& joined, std::size_t cell) {
  for (std::uint64_t f = joined.face_offset[cell]; f < joined.face_offset[cell + 1]; ++f) {
    if (f > joined.face_offset[cell]) file.write(',');
    if (joined.cell_dimension == 3) {
      write_border(file, joined.face_border[f]);
      continue;
    }
    file.write('[');
    for (std::uint64_t e = joined.loop_offset[f]; e < joined.loop_offset[f + 1]; ++e) {
      if (e > joined.loop_offset[f]) file.write(',');
      write_border(file, joined.edge_border[e]);
    }
    file.write(']');
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
void write_shifts(AtomicFile& file, const JoinedCells& joined, std::size_t cell) {
  file.write("],\"shifts\":[");
  for (std::uint64_t f = joined.face_offset[cell]; f < joined.face_offset[cell + 1]; ++f) {
    if (f > joined.face_offset[cell]) file.write(',');
    if (joined.cell_dimension == 3) {
      write_shift(file, joined.shift[f], joined.dimension);
      continue;
    }
    file.write('[');
    for (std::uint64_t e = joined.loop_offset[f]; e < joined.loop_offset[f + 1]; ++e) {
      if (e > joined.loop_offset[f]) file.write(',');
      write_shift(file, joined.shift[e], joined.dimension);
    }
    file.write(']');
  }
}

void write_geometry(AtomicFile& file, const JoinedCells& joined, std::size_t cell) {
  const auto d = static_cast<std::size_t>(joined.dimension);
  file.write(",\"vertices\":[");
  for (std::uint64_t v = joined.vertex_offset[cell]; v < joined.vertex_offset[cell + 1]; ++v) {
    if (v > joined.vertex_offset[cell]) file.write(',');
    write_point(file, &joined.vertices[v * d], d);
  }
  file.write("],\"faces\":[");
  write_faces(file, joined, cell);
  file.write("],\"borders\":[");
  write_borders(file, joined, cell);
  if (!joined.shift.empty()) write_shifts(file, joined, cell);
  file.write(']');
}

void write_cell(AtomicFile& file, const DiagramOutput& output, std::size_t i) {
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
  if (i + 1 < output.joined.vertex_offset.size()) write_geometry(file, output.joined, i);
  file.write('}');
}

std::string json_string(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void write_head(AtomicFile& file, const DiagramOutput& output) {
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
  file.write(
      "},\n\"borders\":\"j >= 0: the cell of seed j; -1-f: facet f of the domain's boundary; null: the same "
      "cell"
      " goes on\",\n\"cells\":[\n");
}

}  // namespace

void write_json(const std::string& path, const DiagramOutput& output) {
  AtomicFile file(path);
  write_head(file, output);
  for (std::size_t i = 0; i < output.seeds.size(); ++i) {
    if (i > 0) file.write(",\n");
    write_cell(file, output, i);
  }
  file.write("\n]}\n");
  file.commit();
}

}  // namespace powercell::io
