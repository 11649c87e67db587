#include "lib/c_api/results.hpp"

namespace powercell::c_api {
namespace {

static_assert(sizeof(Border) == sizeof(pc_border) && alignof(Border) == alignof(pc_border));
static_assert(static_cast<int>(Border::Kind::interior) == PC_BORDER_INTERIOR);
static_assert(static_cast<int>(SeedStatus::duplicate) == PC_SEED_DUPLICATE);
static_assert(sizeof(SeedStatus) == 1);

// Rows of an array of offsets.
std::size_t row_count(const std::vector<std::uint64_t>& offset) {
  return offset.empty() ? 0 : offset.size() - 1;
}

std::size_t vertex_count(const std::vector<double>& vertices, int dimension) {
  return vertices.empty() ? 0 : vertices.size() / static_cast<std::size_t>(dimension);
}

}  // namespace

const pc_border* pointer(const std::vector<Border>& borders) {
  return borders.empty() ? nullptr : reinterpret_cast<const pc_border*>(borders.data());
}

const std::uint8_t* pointer(const std::vector<SeedStatus>& status) {
  return status.empty() ? nullptr : reinterpret_cast<const std::uint8_t*>(status.data());
}

std::vector<Border> borders_of(const pc_border* borders, std::size_t count) {
  std::vector<Border> all;
  for (const pc_border& border : view(borders, count, "an array of borders")) {
    require(border.kind <= PC_BORDER_INTERIOR, "the kind of a border is not a value of pc_border_kind");
    all.push_back({static_cast<Border::Kind>(border.kind), border.index});
  }
  return all;
}

std::vector<std::array<std::int32_t, 3>> shifts_of(const std::int32_t* shifts, std::size_t count) {
  std::vector<std::array<std::int32_t, 3>> all(count);
  for (std::size_t k = 0; k < count; ++k) std::copy_n(shifts + 3 * k, 3, all[k].begin());
  return all;
}

pc_measures view_of(const Measures& from) {
  pc_measures to{};
  to.count = from.mass.size();
  to.dimension = from.dimension;
  to.mass = pointer(from.mass);
  to.centroid = pointer(from.centroid);
  to.second_moment = pointer(from.second_moment);
  to.status = pointer(from.status);
  for (const SeedStatus status : {SeedStatus::ok, SeedStatus::hidden, SeedStatus::duplicate})
    to.status_count[static_cast<std::size_t>(status)] = from.count(status);
  to.domain_measure = from.domain_measure;
  to.total = from.total();
  to.relative_error = from.relative_error();
  return to;
}

pc_adjacency view_of(const Adjacency& from) {
  pc_adjacency to{};
  to.count = row_count(from.offset);
  to.entry_count = from.neighbor.size();
  to.offset = pointer(from.offset);
  to.neighbor = pointer(from.neighbor);
  to.wall = pointer(from.wall);
  to.shift = pointer(from.shift);
  to.asymmetry = from.asymmetry;
  std::copy(from.asymmetric.begin(), from.asymmetric.end(), to.asymmetric);
  return to;
}

pc_boundary_walls view_of(const BoundaryWalls& from) {
  pc_boundary_walls to{};
  to.count = row_count(from.offset);
  to.entry_count = from.facet.size();
  to.offset = pointer(from.offset);
  to.facet = pointer(from.facet);
  to.measure = pointer(from.measure);
  return to;
}

pc_cells view_of(const Cells& from) {
  pc_cells to{};
  to.count = from.cell_count();
  to.piece_count = from.piece_count();
  to.vertex_count = vertex_count(from.vertices, from.dimension);
  to.face_count = from.border.size();
  to.dimension = from.dimension;
  to.cell_dimension = from.cell_dimension;
  to.cell_offset = pointer(from.cell_offset);
  to.region = pointer(from.region);
  to.vertex_offset = pointer(from.vertex_offset);
  to.vertices = pointer(from.vertices);
  to.face_offset = pointer(from.face_offset);
  to.border = pointer(from.border);
  to.shift = pointer(from.shift);
  to.loop_offset = pointer(from.loop_offset);
  to.loop = pointer(from.loop);
  return to;
}

pc_joined_cells view_of(const JoinedCells& from) {
  pc_joined_cells to{};
  to.count = row_count(from.vertex_offset);
  to.vertex_count = vertex_count(from.vertices, from.dimension);
  to.face_count = row_count(from.loop_offset);
  to.loop_count = from.loop.size();
  to.dimension = from.dimension;
  to.cell_dimension = from.cell_dimension;
  to.vertex_offset = pointer(from.vertex_offset);
  to.vertices = pointer(from.vertices);
  to.face_offset = pointer(from.face_offset);
  to.face_border = pointer(from.face_border);
  to.loop_offset = pointer(from.loop_offset);
  to.loop = pointer(from.loop);
  to.edge_border = pointer(from.edge_border);
  to.shift = pointer(from.shift);
  return to;
}

pc_dual view_of(const Dual& from) {
  pc_dual to{};
  to.count = from.size();
  to.corners = from.corners;
  to.simplices = pointer(from.simplices);
  to.shift = pointer(from.shift);
  return to;
}

pc_timings view_of(const Timings& from) {
  return {from.total,
          from.prepare,
          from.pairs,
          from.neighbors,
          from.clip,
          from.collect,
          from.certify,
          from.build,
          from.pair_count,
          from.retried,
          from.on_host,
          from.uncertain,
          static_cast<std::uint64_t>(from.rounds)};
}

}  // namespace powercell::c_api
