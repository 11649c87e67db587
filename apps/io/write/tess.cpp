// Neper's tessellation file, version 3.4, which all of Neper 4 reads.
#include "apps/io/write/tess.hpp"

#include <algorithm>
#include <cmath>
#include <powercell/error.hpp>

#include "apps/io/atomic_file.hpp"
#include "apps/io/write/formats.hpp"

namespace powercell::io {
namespace {

Tess tess_of(const std::string& path, const DiagramOutput& output) {
  Tess tess;
  tess.cells = fitting_cells(path, output);
  const SharedCells& cells = tess.cells;
  for (std::uint32_t i = 0; i < cells.cell_count(); ++i) {
    const std::uint64_t begin = cells.face_offset[i], end = cells.face_offset[i + 1];
    if (begin == end) continue;
    if (cells.cell_dimension == 2 && end - begin > 1)
      throw Error(ErrorCode::write_failed,
                  path + ": the cell of seed " + std::to_string(i) +
                      " has a hole or several parts, which a cell of .tess cannot have; write .vtu or .json");
    tess.seed.push_back(i);
    for (std::uint64_t f = begin; f < end; ++f) {
      if (cells.cell_dimension == 3 && cells.twin[f] < f) continue;
      tess.face.push_back(f);
      const auto loop = cells.face(f);
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const TessEdge edge = std::minmax(loop[k], loop[(k + 1) % loop.size()]);
        if (tess.edge_number.try_emplace(edge, static_cast<std::uint32_t>(tess.edges.size())).second)
          tess.edges.push_back(edge);
      }
    }
  }
  return tess;
}

/// Neper's weights are radii: its power distance is |x - p|^2 - w^2. A constant on all weights changes
/// nothing, so negative ones are raised by the least.
std::vector<double> radii_of(const DiagramOutput& output, const std::vector<std::uint32_t>& seeds) {
  std::vector<double> radii(seeds.size(), 0.0);
  if (output.seeds.weights.empty()) return radii;
  double least = 0;
  for (const std::uint32_t i : seeds) least = std::min(least, output.seeds.weights[i]);
  for (std::size_t k = 0; k < seeds.size(); ++k) radii[k] = std::sqrt(output.seeds.weights[seeds[k]] - least);
  return radii;
}

class TessWriter {
 public:
  TessWriter(const std::string& path, const DiagramOutput& output, const Tess& tess)
      : file_(path), output_(output), tess_(tess), volume_(tess.cells.cell_dimension == 3) {}

  void write(const TessDomain& domain) {
    file_.write("***tess\n **format\n   3.4\n **general\n   ");
    file_.write(volume_ ? "3 standard\n" : "2 standard\n");
    write_cells();
    write_vertices();
    write_edges();
    write_faces();
    if (volume_) write_polyhedra();
    write_domain(domain);
    file_.write("***end\n");
    file_.commit();
  }

 private:
  void count(std::string_view section, std::size_t n) {
    file_.write(section);
    file_.write("\n  ");
    file_.number(std::uint64_t{n});
    file_.write('\n');
  }
  void id(std::uint64_t number) {
    file_.write("  ");
    file_.number(number + 1);
  }
  void signed_id(std::uint64_t number, bool negative) {
    file_.write(negative ? " -" : " ");
    file_.number(number + 1);
  }
  void coordinates(const double* at, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) {
      file_.write(' ');
      file_.number(at[k] + 0.0);  // not -0
    }
  }
  void list(const std::vector<std::uint32_t>& numbers, bool with_size = true) {
    if (with_size) {
      file_.write(' ');
      file_.number(std::uint64_t{numbers.size()});
    }
    for (const std::uint32_t k : numbers) signed_id(k, false);
  }
  void write_cells();
  void write_vertices();
  void write_edges();
  void write_faces();
  void write_polyhedra();
  void write_domain(const TessDomain& domain);

  AtomicFile file_;
  const DiagramOutput& output_;
  const Tess& tess_;
  bool volume_;
};

void TessWriter::write_cells() {
  count(" **cell", tess_.seed.size());
  file_.write("  *id\n  ");
  for (const std::uint32_t i : tess_.seed) signed_id(i, false);
  file_.write("\n  *seed\n");
  const std::vector<double> radii = radii_of(output_, tess_.seed);
  const auto d = static_cast<std::size_t>(output_.seeds.dimension);
  for (std::size_t k = 0; k < tess_.seed.size(); ++k) {
    id(k);
    std::array<double, 4> row{};
    std::copy_n(&output_.seeds.positions[d * tess_.seed[k]], d, row.begin());
    row[3] = radii[k];
    coordinates(row.data(), 4);
    file_.write('\n');
  }
}

void TessWriter::write_vertices() {
  count(" **vertex", tess_.cells.point_count());
  for (std::uint32_t p = 0; p < tess_.cells.point_count(); ++p) {
    id(p);
    coordinates(tess_.cells.point(p), 3);
    file_.write(" 0\n");
  }
}

void TessWriter::write_edges() {
  count(" **edge", tess_.edges.size());
  for (std::size_t e = 0; e < tess_.edges.size(); ++e) {
    id(e);
    signed_id(tess_.edges[e].first, false);
    signed_id(tess_.edges[e].second, false);
    file_.write(" 0\n");
  }
}

void TessWriter::write_faces() {
  count(" **face", tess_.face.size());
  for (std::size_t f = 0; f < tess_.face.size(); ++f) {
    const auto loop = tess_.cells.face(tess_.face[f]);
    id(f);
    list({loop.begin(), loop.end()});
    file_.write("\n    ");
    file_.number(std::uint64_t{loop.size()});
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::uint32_t from = loop[k], to = loop[(k + 1) % loop.size()];
      signed_id(tess_.edge_number.at(std::minmax(from, to)), from > to);
    }
    file_.write("\n   ");
    coordinates(plane_of(tess_.cells, loop).data(), 4);
    file_.write("\n    0 0 0 0 0\n");
  }
}

void TessWriter::write_polyhedra() {
  const SharedCells& cells = tess_.cells;
  std::vector<std::uint32_t> number(cells.face_count());
  for (std::size_t f = 0; f < tess_.face.size(); ++f) number[tess_.face[f]] = static_cast<std::uint32_t>(f);
  count(" **polyhedron", tess_.seed.size());
  for (std::size_t k = 0; k < tess_.seed.size(); ++k) {
    const std::uint64_t begin = cells.face_offset[tess_.seed[k]], end = cells.face_offset[tess_.seed[k] + 1];
    id(k);
    file_.write(' ');
    file_.number(end - begin);
    for (std::uint64_t f = begin; f < end; ++f)
      signed_id(number[std::min(f, cells.twin[f])], cells.twin[f] < f);
    file_.write('\n');
  }
}

void TessWriter::write_domain(const TessDomain& domain) {
  file_.write(" **domain\n  *general\n   ");
  file_.write(domain.box ? "cube\n" : "poly\n");
  count("  *vertex", domain.vertices.size());
  for (std::size_t v = 0; v < domain.vertices.size(); ++v) {
    id(v);
    coordinates(tess_.cells.point(domain.vertices[v].point), 3);
    file_.write(" " + domain.vertices[v].label + "\n     1");
    signed_id(domain.vertices[v].point, false);
    file_.write('\n');
  }
  count("  *edge", domain.edges.size());
  for (std::size_t e = 0; e < domain.edges.size(); ++e) {
    id(e);
    list(domain.edges[e].vertices);
    file_.write("\n     " + domain.edges[e].label + "\n    ");
    list(domain.edges[e].edges);
    file_.write('\n');
  }
  if (!volume_) return;
  count("  *face", domain.faces.size());
  for (std::size_t f = 0; f < domain.faces.size(); ++f) {
    id(f);
    list(domain.faces[f].vertices);
    file_.write("\n    ");
    list(domain.faces[f].edges);
    file_.write("\n     plane\n     4");
    coordinates(domain.faces[f].plane.data(), 4);
    file_.write("\n     " + domain.faces[f].label + "\n    ");
    list(domain.faces[f].faces);
    file_.write('\n');
  }
}

}  // namespace

std::array<double, 4> plane_of(const SharedCells& cells, std::span<const std::uint32_t> loop) {
  const double* o = cells.point(loop[0]);
  std::array<double, 3> normal{};
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
    const double *a = cells.point(loop[k]), *b = cells.point(loop[k + 1]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      normal[axis] += (a[u] - o[u]) * (b[v] - o[v]) - (a[v] - o[v]) * (b[u] - o[u]);
    }
  }
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  std::array<double, 4> plane{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    plane[axis + 1] = length > 0 ? normal[axis] / length : 0.0;
    plane[0] += plane[axis + 1] * o[axis];
  }
  return plane;
}

void write_tess(const std::string& path, const DiagramOutput& output) {
  const Tess tess = tess_of(path, output);
  const TessDomain domain = domain_of(path, output, tess);
  TessWriter(path, output, tess).write(domain);
}

}  // namespace powercell::io
