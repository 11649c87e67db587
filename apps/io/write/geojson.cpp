#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "apps/io/atomic_file.hpp"
#include "apps/io/names.hpp"
#include "apps/io/tables/kept_columns.hpp"
#include "apps/io/write/formats.hpp"

namespace powercell::io {
namespace {

using Point = std::array<double, 2>;
using Points = std::vector<Point>;

/// An outer ring and the holes in it.
struct Part {
  Points outer;
  double area = 0;
  std::vector<Points> holes;
};

double ring_area(const Points& ring) {
  double twice = 0;
  const Point& o = ring[0];
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
    const Point &a = ring[k], &b = ring[k + 1];
    twice += (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  }
  return twice / 2;
}

bool contains(const Points& ring, const Point& p) {
  bool inside = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point &a = ring[k], &b = ring[(k + 1) % ring.size()];
    if ((a[1] > p[1]) == (b[1] > p[1])) continue;
    inside ^= p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
  }
  return inside;
}

// The smallest part around a hole. A hole may touch its outer ring in a vertex, so the middle of an edge
// is tested.
Part* part_around(std::vector<Part>& parts, const Points& hole) {
  const Point middle = {(hole[0][0] + hole[1][0]) / 2, (hole[0][1] + hole[1][1]) / 2};
  Part* found = nullptr;
  for (Part& part : parts)
    if (contains(part.outer, middle) && (!found || part.area < found->area)) found = &part;
  return found;
}

std::vector<Part> parts_of(const JoinedCells& joined, std::size_t cell) {
  std::vector<Part> parts;
  std::vector<Points> holes;
  for (std::uint64_t f = joined.face_offset[cell]; f < joined.face_offset[cell + 1]; ++f) {
    Points ring;
    for (std::uint64_t e = joined.loop_offset[f]; e < joined.loop_offset[f + 1]; ++e) {
      const double* vertex = &joined.vertices[(joined.vertex_offset[cell] + joined.loop[e]) * 2];
      ring.push_back({vertex[0], vertex[1]});
    }
    const double area = ring_area(ring);
    if (area > 0)
      parts.push_back({std::move(ring), area, {}});
    else
      holes.push_back(std::move(ring));
  }
  for (Points& hole : holes) {
    Part* part = part_around(parts, hole);
    if (!part)
      throw Error(ErrorCode::internal,
                  "the cell of seed " + std::to_string(cell) + " has a hole outside of its parts");
    part->holes.push_back(std::move(hole));
  }
  return parts;
}

/// The ring on the map of the inputs. It begins where it does in the plane.
Points on_map(const Points& ring, const MapPlane& plane) {
  Points path;
  for (std::size_t k = 0; k < ring.size(); ++k)
    plane.trace_to_map(ring[k], ring[(k + 1) % ring.size()], path);
  std::rotate(path.begin(), path.end() - 1, path.end());
  return path;
}

void write_ring(AtomicFile& file, const Points& ring) {
  file.write('[');
  for (std::size_t k = 0; k <= ring.size(); ++k) {
    const Point& p = ring[k % ring.size()];
    file.write(k > 0 ? ",[" : "[");
    file.number(p[0]);
    file.write(',');
    file.number(p[1]);
    file.write(']');
  }
  file.write(']');
}

void write_part(AtomicFile& file, const Part& part, const MapPlane* plane) {
  file.write('[');
  write_ring(file, plane ? on_map(part.outer, *plane) : part.outer);
  for (const Points& hole : part.holes) {
    file.write(',');
    write_ring(file, plane ? on_map(hole, *plane) : hole);
  }
  file.write(']');
}

void write_shape(AtomicFile& file, const std::vector<Part>& parts, const MapPlane* plane) {
  if (parts.empty()) {
    file.write("null");
    return;
  }
  file.write(parts.size() == 1 ? R"({"type":"Polygon","coordinates":)"
                               : R"({"type":"MultiPolygon","coordinates":[)");
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k > 0) file.write(',');
    write_part(file, parts[k], plane);
  }
  file.write(parts.size() == 1 ? "}" : "]}");
}

nlohmann::json value_of(const KeptColumns& kept, std::size_t row, const KeptColumn& column) {
  const std::string_view field = kept.field(row, column);
  if (column.type != KeptColumn::Type::text && field.empty()) return nullptr;
  if (column.type == KeptColumn::Type::text) return std::string(field);
  if (kept.mark() == ',') return kept.number(row, column);
  return nlohmann::json::parse(field);
}

std::string text_of(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Number of the seed, or its field of the column of ids.
std::string id_of(const DiagramOutput& output, std::size_t seed) {
  const SeedTable* table = output.inputs.table;
  if (table == nullptr || !table->columns.id || table->text.columns == 0) return std::to_string(seed);
  return text_of(std::string(table->text.field(seed, *table->columns.id)));
}

void write_feature(AtomicFile& file, const DiagramOutput& output, const KeptColumns& kept, std::size_t i) {
  file.write("{\"type\":\"Feature\",\"id\":" + id_of(output, i) + ",\"properties\":{");
  for (const KeptColumn& column : kept.columns())
    file.write(text_of(column.name) + ":" + text_of(value_of(kept, i, column)) + ",");
  file.write("\"seed\":");
  file.number(std::uint64_t{i});
  if (!kept.has_weights()) {
    file.write(",\"weight\":");
    file.number(output.seeds.weights.empty() ? 0.0 : output.seeds.weights[i]);
  }
  file.write(",\"status\":\"");
  file.write(name(output.measures.status[i]));
  file.write("\",\"measure\":");
  file.number(output.measures.mass[i]);
  file.write("},\"geometry\":");
  write_shape(file, parts_of(output.joined, i), output.inputs.plane());
  file.write('}');
}

}  // namespace

void write_geojson(const std::string& path, const DiagramOutput& output) {
  const KeptColumns kept(output.inputs, output.seeds, {"seed", "status", "measure"});
  AtomicFile file(path);
  const MapFrame* map = output.inputs.map;
  file.write("{\"type\":\"FeatureCollection\",");
  if (map && !map->member.empty()) file.write("\"crs\":" + map->member + ",");
  file.write("\"features\":[\n");
  for (std::size_t i = 0; i < output.seeds.size(); ++i) {
    file.write(i > 0 ? ",\n" : "");
    write_feature(file, output, kept, i);
  }
  file.write("\n]}\n");
  file.commit();
}

}  // namespace powercell::io
