#include "tests/device_diagram/cell_memory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

namespace powercell::test {

CellRoom room_of(const Cells& cells) {
  return {2 * cells.region.size() + 100, 2 * cells.vertices.size() + 100, 2 * cells.border.size() + 100,
          2 * cells.loop.size() + 100};
}

CellMemory::CellMemory(const Caller& caller, Precision precision, const Domain& domain, std::size_t n,
                       CellRoom room)
    : caller_(caller),
      precision_(precision),
      volume_(domain.cell_dimension() == 3),
      periodic_(domain.is_periodic()),
      dimension_(static_cast<std::size_t>(domain.dimension())),
      n_(n),
      room_(room),
      marks_(std::max<std::size_t>(room.pieces, 1), unwritten),
      counts_(caller, 4 * sizeof(cl_ulong)),
      cell_offset_(caller, (n + 1) * sizeof(cl_ulong)),
      region_(caller, marks_.size() * sizeof(cl_uint), marks_.data()),
      vertex_offset_(caller, (room.pieces + 1) * sizeof(cl_ulong)),
      vertices_(caller, room.vertices * dimension_ *
                            (precision == Precision::float32 ? sizeof(float) : sizeof(double))),
      face_offset_(caller, (room.pieces + 1) * sizeof(cl_ulong)),
      border_(caller, room.faces * sizeof(Border)),
      shift_(caller, room.faces * 3 * sizeof(cl_int)),
      loop_offset_(caller, (room.faces + 1) * sizeof(cl_ulong)),
      loop_(caller, room.loop * sizeof(cl_uint)) {}

DeviceCells CellMemory::handles() const {
  DeviceCells to{counts_.handle(),   cell_offset_.handle(), region_.handle(), vertex_offset_.handle(),
                 vertices_.handle(), face_offset_.handle(), border_.handle()};
  if (periodic_) to.shift = shift_.handle();
  if (volume_) to.loop_offset = loop_offset_.handle();
  if (volume_) to.loop = loop_.handle();
  return to;
}

Cells CellMemory::read(std::size_t pieces) const {
  const cl_command_queue queue = caller_.queue();
  Cells cells;
  cells.dimension = static_cast<int>(dimension_);
  cells.cell_dimension = volume_ ? 3 : 2;
  cells.cell_offset = cell_offset();
  cells.region = region_.values<cl_uint>(queue, pieces);
  cells.vertex_offset = vertex_offset_.values<std::uint64_t>(queue, pieces + 1);
  cells.face_offset = face_offset_.values<std::uint64_t>(queue, pieces + 1);
  const std::size_t coordinates = cells.vertex_offset.back() * dimension_, faces = cells.face_offset.back();
  if (precision_ == Precision::float32) {
    const std::vector<float> narrow = vertices_.values<float>(queue, coordinates);
    cells.vertices.assign(narrow.begin(), narrow.end());
  } else {
    cells.vertices = vertices_.values<double>(queue, coordinates);
  }
  cells.border = border_.values<Border>(queue, faces);
  if (periodic_) cells.shift = shift_.values<std::array<std::int32_t, 3>>(queue, faces);
  if (!volume_) return cells;
  cells.loop_offset = loop_offset_.values<std::uint64_t>(queue, faces + 1);
  cells.loop = loop_.values<cl_uint>(queue, cells.loop_offset.back());
  return cells;
}

namespace {

using Point = std::array<double, 3>;

Point point_of(const Cells& cells, std::uint64_t vertex) {
  Point p{};
  const auto d = static_cast<std::size_t>(cells.dimension);
  for (std::size_t k = 0; k < d; ++k) p[k] = cells.vertices[vertex * d + k];
  return p;
}

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Twice the area vector of a polygon by some vertices of a piece.
Point area_of(const Cells& cells, std::uint64_t first, const std::vector<std::uint32_t>& corners) {
  Point sum{};
  const Point o = point_of(cells, first + corners[0]);
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const Point n = cross(minus(point_of(cells, first + corners[k]), o),
                          minus(point_of(cells, first + corners[k + 1]), o));
    for (std::size_t c = 0; c < 3; ++c) sum[c] += n[c];
  }
  return sum;
}

double polygon_area(const Cells& cells, std::uint64_t p) {
  std::vector<std::uint32_t> corners(cells.vertex_offset[p + 1] - cells.vertex_offset[p]);
  for (std::uint32_t v = 0; v < corners.size(); ++v) corners[v] = v;
  const Point n = area_of(cells, cells.vertex_offset[p], corners);
  CHECK(corners.size() == cells.face_offset[p + 1] - cells.face_offset[p]);
  return cells.dimension == 2 ? n[2] / 2 : std::hypot(n[0], n[1], n[2]) / 2;
}

double polyhedron_volume(const Cells& cells, std::uint64_t p) {
  const std::uint64_t first = cells.vertex_offset[p];
  const Point top = point_of(cells, first);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;  // + one way, - the other
  double sum = 0;
  for (std::uint64_t f = cells.face_offset[p]; f < cells.face_offset[p + 1]; ++f) {
    const std::vector<std::uint32_t> loop(
        cells.loop.begin() + static_cast<std::ptrdiff_t>(cells.loop_offset[f]),
        cells.loop.begin() + static_cast<std::ptrdiff_t>(cells.loop_offset[f + 1]));
    REQUIRE(loop.size() >= 3);
    const Point n = area_of(cells, first, loop), h = minus(point_of(cells, first + loop[0]), top);
    sum += (n[0] * h[0] + n[1] * h[1] + n[2] * h[2]) / 6;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::uint32_t a = loop[k], b = loop[(k + 1) % loop.size()];
      edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : 101;
    }
  }
  CHECK(std::all_of(edges.begin(), edges.end(), [](const auto& e) { return e.second == 102; }));
  return sum;
}

/// The borders of a piece in ascending order, with their shifts.
auto borders_of(const Cells& cells, std::uint64_t p) {
  std::vector<std::tuple<std::uint32_t, std::uint32_t, std::array<std::int32_t, 3>>> all;
  for (std::uint64_t f = cells.face_offset[p]; f < cells.face_offset[p + 1]; ++f)
    all.emplace_back(static_cast<std::uint32_t>(cells.border[f].kind), cells.border[f].index,
                     cells.shift.empty() ? std::array<std::int32_t, 3>{} : cells.shift[f]);
  std::sort(all.begin(), all.end());
  return all;
}

bool vertices_are_near(const Cells& a, std::uint64_t p, const Cells& b, std::uint64_t q, double error) {
  for (std::uint64_t v = a.vertex_offset[p]; v < a.vertex_offset[p + 1]; ++v) {
    const Point x = point_of(a, v);
    bool found = false;
    for (std::uint64_t w = b.vertex_offset[q]; w < b.vertex_offset[q + 1] && !found; ++w) {
      const Point y = minus(x, point_of(b, w));
      found = std::max({std::abs(y[0]), std::abs(y[1]), std::abs(y[2])}) <= error;
    }
    if (!found) return false;
  }
  return true;
}

/// The pieces of a cell by region.
std::map<std::uint32_t, std::uint64_t> pieces_of(const Cells& cells, std::size_t i) {
  std::map<std::uint32_t, std::uint64_t> pieces;
  for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p) pieces[cells.region[p]] = p;
  CHECK(pieces.size() == cells.cell_offset[i + 1] - cells.cell_offset[i]);
  return pieces;
}

}  // namespace

double measure_of_cell(const Cells& cells, std::size_t i) {
  double sum = 0;
  for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p)
    sum += cells.cell_dimension == 3 ? polyhedron_volume(cells, p) : polygon_area(cells, p);
  return sum;
}

bool same_cell(const Cells& a, const Cells& b, std::size_t i, double error) {
  const auto left = pieces_of(a, i), right = pieces_of(b, i);
  if (left.size() != right.size()) return false;
  for (const auto& [region, p] : left) {
    const auto found = right.find(region);
    if (found == right.end()) return false;
    const std::uint64_t q = found->second;
    if (borders_of(a, p) != borders_of(b, q)) return false;
    if (a.vertex_offset[p + 1] - a.vertex_offset[p] != b.vertex_offset[q + 1] - b.vertex_offset[q])
      return false;
    if (!vertices_are_near(a, p, b, q, error) || !vertices_are_near(b, q, a, p, error)) return false;
  }
  return true;
}

double reach_of(const Cells& cells, std::size_t i, const double* point) {
  double most = 0;
  const auto d = static_cast<std::size_t>(cells.dimension);
  for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p)
    for (std::uint64_t v = cells.vertex_offset[p]; v < cells.vertex_offset[p + 1]; ++v) {
      double square = 0;
      for (std::size_t k = 0; k < d; ++k) {
        const double x = cells.vertices[v * d + k] - point[k];
        square += x * x;
      }
      most = std::max(most, std::sqrt(square));
    }
  return most;
}

}  // namespace powercell::test
