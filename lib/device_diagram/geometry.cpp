#include "lib/device_diagram/geometry.hpp"

#include <algorithm>

#include "kernels/layout.h"
#include "lib/clip/golden.hpp"
#include "lib/neighbors/tree_candidates.hpp"

namespace powercell {
namespace {

static_assert(BORDER_WALL == static_cast<int>(Border::Kind::wall));

constexpr const char* rows_file = "device_diagram/cells.cl";
/// The memory of the rows of one capacity, in bytes.
constexpr std::size_t row_budget = std::size_t{128} << 20;
/// Of the pieces that did not fit (kernels/device_diagram/cells.cl).
constexpr std::uint32_t not_counted = 0xffffffffu;

std::vector<std::string> without_cell(Variant variant) {
  variant.capacity = {1, 1};
  return variant.defines();
}

/// The program that Diagram searches and clips with, tested with the golden diagram before its first use.
std::shared_ptr<const cl::Program> clip_program(const std::shared_ptr<cl::Context>& context,
                                                const Variant& variant) {
  auto program = context->program("clip/by_tree.cl", variant.defines());
  program->trust_after([&] {
    const RegionMesh mesh = golden_mesh(variant);
    const SeedSet seeds = golden_seeds(variant.dimension);
    const PackedTree tree = build_packed_tree(seeds, 1);
    const OwnScene own(context, mesh, variant.float32, seeds, tree);
    const std::vector<Capacity>& all = capacities(variant.cell_dimension);
    const auto same = [&](const Capacity& c) { return c.vertices == variant.capacity.vertices; };
    golden_test(context, TreeCandidates(own.scene), variant,
                static_cast<std::size_t>(std::find_if(all.begin(), all.end(), same) - all.begin()));
  });
  return program;
}

std::size_t real_bytes(const Variant& variant) {
  return variant.float32 ? sizeof(float) : sizeof(double);
}

/// Of a row: per vertex, and per face.
std::size_t vertex_bytes(const Variant& variant) {
  const std::size_t links = variant.cell_dimension == 3 ? 6 * sizeof(cl_uint) : 0;
  return static_cast<std::size_t>(variant.dimension) * real_bytes(variant) + links;
}
std::size_t face_bytes(const Variant& variant) {
  return sizeof(cl_int) + real_bytes(variant);
}

}  // namespace

DeviceGeometry::Rows::Rows(const DomainBuffers& domain, Variant variant_in)
    : variant(variant_in),
      clip(domain.context(), clip_program(domain.context(), variant), "clip_by_tree_kernel"),
      active(domain.context()),
      status(domain.context()),
      faces(domain.context()),
      vertices(domain.context()),
      link(domain.context()),
      border(domain.context()),
      wall(domain.context()),
      vertex(domain.context()) {}

void DeviceGeometry::Rows::reserve(std::uint32_t rows) {
  count = rows;
  const std::size_t all_vertices = std::size_t{rows} * static_cast<std::size_t>(variant.capacity.vertices),
                    all_faces = std::size_t{rows} * static_cast<std::size_t>(variant.capacity.faces);
  for (cl::Buffer<std::uint32_t>* by_row : {&active, &status, &faces, &vertices}) by_row->resize(rows);
  link.resize(variant.cell_dimension == 3 ? all_vertices * 6 : 0);
  border.resize(all_faces);
  wall.reserve(all_faces * real_bytes(variant));
  vertex.reserve(all_vertices * static_cast<std::size_t>(variant.dimension) * real_bytes(variant));
}

DeviceGeometry::DeviceGeometry(const DomainBuffers& domain, const DeviceFacets& facets,
                               const Variant& variant, std::uint64_t most)
    : domain_(domain),
      facets_(facets),
      most_(most),
      choose_(domain.context(), domain.context()->program(rows_file, without_cell(variant)), "choose_rows"),
      count_(domain.context(), domain.context()->program(rows_file, without_cell(variant)), "count_rows"),
      size_(domain.context(), domain.context()->program(rows_file, without_cell(variant)), "size_cells"),
      place_(domain.context(), domain.context()->program(rows_file, without_cell(variant)), "place_pieces"),
      write_(domain.context(), domain.context()->program(rows_file, without_cell(variant)), "write_rows"),
      scan_(domain.context(), ExclusiveScan::Type::uint64),
      compaction_(domain.context()),
      faces_(domain.context()),
      vertices_(domain.context()),
      list_(domain.context()),
      found_(domain.context()),
      place_piece_(domain.context()),
      place_vertex_(domain.context()),
      place_face_(domain.context()),
      cell_vertices_(domain.context()),
      cell_faces_(domain.context()) {
  const std::vector<Capacity>& all = capacities(variant.cell_dimension);
  rows_.reserve(all.size());
  for (const Capacity& capacity : all) {
    Variant used = variant;
    used.capacity = capacity;
    rows_.emplace_back(domain, used);
  }
}

std::uint32_t DeviceGeometry::rows_that_fit(const Variant& variant, std::uint32_t pairs) const {
  const std::size_t row = static_cast<std::size_t>(variant.capacity.vertices) * vertex_bytes(variant) +
                          static_cast<std::size_t>(variant.capacity.faces) * face_bytes(variant);
  return static_cast<std::uint32_t>(std::min({row_budget / row, std::size_t{most_}, std::size_t{pairs}}));
}

void DeviceGeometry::clip(std::size_t capacity, std::uint32_t first, const Clipped& from, bool placed) {
  Rows& rows = rows_[capacity];
  const DevicePairs& pairs = from.pairs;
  choose_
      .args(rows.count, first, pairs.capacity, from.n, pairs.offset, cl_int{capacity > 0}, list_, found_,
            from.pair_status, cl_int{placed}, place_piece_, rows.active)
      .submit(rows.count);
  const cl_mem none = rows.wall.handle();  // the reach of cells is not wanted
  rows.clip.args(rows.count, cl_uint{OUTPUT_MOMENTS | OUTPUT_GEOMETRY}, rows.active, pairs.seed, pairs.region,
                 domain_.corners, domain_.region_offset, domain_.region_vertex, domain_.behind, domain_.shape,
                 rows.status, from.moments, rows.faces, rows.border, rows.wall, rows.vertices, rows.vertex,
                 rows.link, none);
  from.blocks.append_arguments(rows.clip, from.tree);
  rows.clip.submit(rows.count);
}

void DeviceGeometry::count(const Clipped& from) {
  const std::uint32_t pairs = from.pairs.capacity;
  for (cl::Buffer<std::uint32_t>* by_pair : {&faces_, &vertices_, &list_}) by_pair->resize(pairs);
  for (cl::Buffer<std::uint64_t>* by_pair : {&place_piece_, &place_vertex_, &place_face_})
    by_pair->resize(pairs);
  found_.resize(1);
  faces_.zero();
  for (std::size_t capacity = 0; capacity < rows_.size(); ++capacity) {
    Rows& rows = rows_[capacity];
    rows.reserve(rows_that_fit(rows.variant, pairs));
    if (capacity > 0)
      compaction_.enqueue(faces_.handle(), pairs, not_counted, list_.handle(), pairs, found_.handle());
    for (std::uint64_t first = 0; first < pairs; first += rows.count) {
      clip(capacity, static_cast<std::uint32_t>(first), from, false);
      count_
          .args(rows.count, cl_int{capacity + 1 == rows_.size()}, rows.active, rows.status, rows.faces,
                rows.vertices, from.pair_status, faces_, vertices_)
          .submit(rows.count);
    }
  }
}

void DeviceGeometry::write_rows(const Rows& rows, const Clipped& from, cl_mem frame, cl_mem positions,
                                const DeviceCells& to) {
  const DeviceImages* images = from.images;
  const cl_mem none = found_.handle();  // kernels need some buffer
  const auto stride = [](int capacity) { return static_cast<cl_uint>(capacity); };
  write_
      .args(rows.count, stride(rows.variant.capacity.vertices), stride(rows.variant.capacity.faces),
            rows.active, rows.status, rows.faces, rows.border, rows.vertices, rows.vertex, rows.link,
            from.pairs.seed, from.pairs.region, frame, positions, from.n, from.seeds.order,
            cl_int{images != nullptr}, images ? images->image_seed.handle() : none,
            images ? images->image_shift.handle() : none, images ? images->shift_given.handle() : none,
            images ? from.seeds.wrap->shift.handle() : none, facets_.offset, facets_.facet, place_piece_,
            place_vertex_, place_face_)
      .more_args(to.region, to.vertex_offset, to.vertices, to.face_offset, to.border,
                 images ? to.shift : none, to.loop_offset ? to.loop_offset : none, to.loop ? to.loop : none)
      .submit(rows.count);
}

void DeviceGeometry::write(const Clipped& from, cl_mem status, cl_mem frame, cl_mem positions,
                           const DeviceCells& to, const CellRooms& room) {
  const std::uint32_t n = from.n, pairs = from.pairs.capacity;
  const std::size_t places = std::size_t{n} + 1;
  for (cl::Buffer<std::uint64_t>* by_seed : {&cell_vertices_, &cell_faces_}) by_seed->resize(places);
  size_
      .args(n, from.seeds.order, status, from.pairs.offset, from.pair_status, faces_, vertices_,
            to.cell_offset, cell_vertices_, cell_faces_)
      .submit(places);
  for (const cl_mem sums : {to.cell_offset, cell_vertices_.handle(), cell_faces_.handle()})
    scan_.enqueue(sums, n + 1);
  place_
      .args(n, pairs, from.seeds.order, status, from.pairs.offset, from.pair_status, faces_, vertices_,
            to.cell_offset, cell_vertices_, cell_faces_, cl_ulong{room.pieces}, cl_ulong{room.vertices},
            cl_ulong{room.faces}, cl_ulong{room.loop}, place_piece_, place_vertex_, place_face_, to.counts,
            to.vertex_offset, to.face_offset, to.loop_offset ? to.loop_offset : found_.handle())
      .submit(places);
  for (std::size_t capacity = 0; capacity < rows_.size(); ++capacity) {
    const Rows& rows = rows_[capacity];
    for (std::uint64_t first = 0; first < pairs; first += rows.count) {
      // Rows of all pairs are still those that were counted.
      if (rows.count < pairs) clip(capacity, static_cast<std::uint32_t>(first), from, true);
      write_rows(rows, from, frame, positions, to);
    }
  }
}

}  // namespace powercell
