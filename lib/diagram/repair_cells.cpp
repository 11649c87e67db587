#include "lib/diagram/repair_cells.hpp"

#include <array>
#include <string>
#include <vector>

#include "lib/cl/transfers.hpp"

namespace powercell {
namespace {

static_assert(sizeof(Border) == 2 * sizeof(cl_uint) &&
              sizeof(std::array<std::int32_t, 3>) == 3 * sizeof(cl_int));

/// The numbers of DeviceCells::counts.
CellRooms counts_of(const Cells& cells) {
  return {cells.region.size(), cells.vertices.size() / static_cast<std::size_t>(cells.dimension),
          cells.border.size(), cells.loop.size()};
}

bool fits(const CellRooms& counts, const CellRooms& room) {
  return counts.pieces <= room.pieces && counts.vertices <= room.vertices && counts.faces <= room.faces &&
         counts.loop <= room.loop;
}

std::string in_words(const CellRooms& rooms) {
  return std::to_string(rooms.pieces) + " pieces, " + std::to_string(rooms.vertices) + " vertices, " +
         std::to_string(rooms.faces) + " faces and " + std::to_string(rooms.loop) + " entries of loops";
}

/// Appends entries [begin, end) of `values`, of `width` values each.
template <class T>
void append(std::vector<T>& to, const std::vector<T>& values, std::uint64_t begin, std::uint64_t end,
            std::size_t width = 1) {
  to.insert(to.end(), values.begin() + static_cast<std::ptrdiff_t>(begin * width),
            values.begin() + static_cast<std::ptrdiff_t>(end * width));
}

void append_piece(Cells& to, const Cells& from, std::uint64_t p) {
  const auto d = static_cast<std::size_t>(from.dimension);
  const std::uint64_t first = from.face_offset[p], last = from.face_offset[p + 1];
  to.region.push_back(from.region[p]);
  append(to.vertices, from.vertices, from.vertex_offset[p], from.vertex_offset[p + 1], d);
  append(to.border, from.border, first, last);
  if (!from.shift.empty()) append(to.shift, from.shift, first, last);
  to.vertex_offset.push_back(to.vertices.size() / d);
  to.face_offset.push_back(to.border.size());
  if (from.loop_offset.empty()) return;
  for (std::uint64_t f = first; f < last; ++f) {
    append(to.loop, from.loop, from.loop_offset[f], from.loop_offset[f + 1]);
    to.loop_offset.push_back(to.loop.size());
  }
}

}  // namespace

Cells read_cells(const std::shared_ptr<cl::Context>& context, const DeviceCells& from, std::uint32_t n, int d,
                 bool float32, const CellRooms& room) {
  std::array<cl_ulong, 4> numbers{};
  cl::Reads of_counts(context);
  of_counts.add(from.counts, numbers.data(), sizeof numbers);
  of_counts.wait();
  const CellRooms counts{numbers[0], numbers[1], numbers[2], numbers[3]};
  if (!fits(counts, room))
    throw Error(ErrorCode::invalid_argument,
                "the cells have " + in_words(counts) + ", and their buffers have room for " + in_words(room) +
                    ", so that some cells were not written; enqueue the diagram again with larger ones, and "
                    "repair that");
  Cells cells;
  cells.dimension = d;
  cells.cell_dimension = from.loop ? 3 : 2;
  cl::Reads reads(context);
  const auto read = [&](cl_mem memory, auto& values, std::uint64_t count) {
    values.resize(count);
    if (count > 0) reads.add(memory, values.data(), count * sizeof values[0]);
  };
  std::vector<float> narrow;
  const std::uint64_t coordinates = counts.vertices * static_cast<std::uint64_t>(d);
  read(from.cell_offset, cells.cell_offset, std::uint64_t{n} + 1);
  read(from.region, cells.region, counts.pieces);
  read(from.vertex_offset, cells.vertex_offset, counts.pieces + 1);
  float32 ? read(from.vertices, narrow, coordinates) : read(from.vertices, cells.vertices, coordinates);
  read(from.face_offset, cells.face_offset, counts.pieces + 1);
  read(from.border, cells.border, counts.faces);
  if (from.shift) read(from.shift, cells.shift, counts.faces);
  if (from.loop) read(from.loop_offset, cells.loop_offset, counts.faces + 1);
  if (from.loop) read(from.loop, cells.loop, counts.loop);
  reads.wait();
  if (float32) cells.vertices.assign(narrow.begin(), narrow.end());
  return cells;
}

Cells merge_cells(const Cells& all, std::span<const std::uint32_t> listed, const Cells& exact) {
  constexpr std::uint32_t none = 0xffffffffu;
  const std::size_t n = all.cell_count();
  std::vector<std::uint32_t> place(n, none);
  for (std::uint32_t k = 0; k < listed.size(); ++k) place[listed[k]] = k;
  Cells to;
  to.dimension = all.dimension;
  to.cell_dimension = all.cell_dimension;
  to.cell_offset = to.vertex_offset = to.face_offset = {0};
  if (all.cell_dimension == 3) to.loop_offset = {0};
  for (std::size_t i = 0; i < n; ++i) {
    const Cells& from = place[i] == none ? all : exact;
    const std::size_t row = place[i] == none ? i : place[i];
    for (std::uint64_t p = from.cell_offset[row]; p < from.cell_offset[row + 1]; ++p)
      append_piece(to, from, p);
    to.cell_offset.push_back(to.region.size());
  }
  return to;
}

void require_room(const Cells& cells, const CellRooms& room) {
  const CellRooms counts = counts_of(cells);
  if (!fits(counts, room))
    throw Error(ErrorCode::invalid_argument,
                "the repaired cells have " + in_words(counts) + ", and their buffers have room for " +
                    in_words(room) + "; enqueue the diagram again with larger ones, and repair that");
}

void write_cells(const cl::Context& context, const DeviceCells& to, const Cells& cells, bool float32) {
  const auto write = [&](cl_mem memory, const auto& values) {
    if (values.empty() || !memory) return;
    cl::check(cl::clEnqueueWriteBuffer(context.queue(), memory, CL_TRUE, 0, values.size() * sizeof values[0],
                                       values.data(), 0, nullptr, nullptr),
              "writing repaired cells to the caller's buffer");
  };
  const CellRooms counts = counts_of(cells);
  write(to.counts, std::array<cl_ulong, 4>{counts.pieces, counts.vertices, counts.faces, counts.loop});
  write(to.cell_offset, cells.cell_offset);
  write(to.region, cells.region);
  write(to.vertex_offset, cells.vertex_offset);
  float32 ? write(to.vertices, std::vector<float>(cells.vertices.begin(), cells.vertices.end()))
          : write(to.vertices, cells.vertices);
  write(to.face_offset, cells.face_offset);
  write(to.border, cells.border);
  write(to.shift, cells.shift);
  write(to.loop_offset, cells.loop_offset);
  write(to.loop, cells.loop);
}

}  // namespace powercell
