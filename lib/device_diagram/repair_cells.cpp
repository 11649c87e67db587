#include "lib/device_diagram/repair_cells.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <powercell/error.hpp>
#include <string>
#include <vector>

#include "lib/cl/transfers.hpp"
#include "lib/collect/walls.hpp"

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

namespace {

/// \throw Error invalid_argument
[[noreturn]] void refuse_room(const char* which, std::size_t entries, std::uint32_t room, const char* why) {
  throw Error(ErrorCode::invalid_argument,
              std::string("the ") + which + "boundary walls have " + std::to_string(entries) +
                  " entries, and their buffers have room for " + std::to_string(room) + why +
                  "; enqueue the diagram again with larger ones, and repair that");
}

}  // namespace

BoundaryWalls read_boundary(const std::shared_ptr<cl::Context>& context, const DeviceBoundaryWalls& from,
                            std::uint32_t n, bool float32, std::uint32_t room) {
  std::vector<cl_uint> offset(std::size_t{n} + 1);
  cl::Reads of_offsets(context);
  of_offsets.add(from.offset, offset.data(), offset.size() * sizeof(cl_uint));
  of_offsets.wait();
  BoundaryWalls walls;
  walls.offset.assign(offset.begin(), offset.end());
  const std::size_t entries = offset.back();
  if (entries > room) refuse_room("", entries, room, ", so that some rows were not written");
  if (entries == 0) return walls;
  walls.facet.resize(entries);
  walls.measure.resize(entries);
  std::vector<float> narrow(float32 ? entries : 0);
  cl::Reads reads(context);
  reads.add(from.facet, walls.facet.data(), entries * sizeof(cl_uint));
  if (float32)
    reads.add(from.measure, narrow.data(), entries * sizeof(float));
  else
    reads.add(from.measure, walls.measure.data(), entries * sizeof(double));
  reads.wait();
  if (float32) walls.measure.assign(narrow.begin(), narrow.end());
  return walls;
}

BoundaryWalls merge_boundary(const BoundaryWalls& all, std::span<const std::uint32_t> listed,
                             const BoundaryWalls& exact) {
  constexpr std::uint32_t none = 0xffffffffu;
  const std::size_t n = all.offset.size() - 1;
  std::vector<std::uint32_t> place(n, none);
  for (std::uint32_t k = 0; k < listed.size(); ++k) place[listed[k]] = k;
  BoundaryWalls to;
  to.offset.reserve(n + 1);
  to.offset.push_back(0);
  for (std::size_t i = 0; i < n; ++i) {
    const BoundaryWalls& from = place[i] == none ? all : exact;
    const std::size_t row = place[i] == none ? i : place[i];
    for (std::uint64_t k = from.offset[row]; k < from.offset[row + 1]; ++k) {
      to.facet.push_back(from.facet[k]);
      to.measure.push_back(from.measure[k]);
    }
    to.offset.push_back(to.facet.size());
  }
  return to;
}

void require_room(const BoundaryWalls& walls, std::uint32_t room) {
  if (walls.facet.size() > room) refuse_room("repaired ", walls.facet.size(), room, "");
}

void write_boundary(const cl::Context& context, const DeviceBoundaryWalls& to, const BoundaryWalls& walls,
                    bool float32) {
  const auto write = [&](cl_mem memory, const auto& values) {
    if (values.empty()) return;
    cl::check(cl::clEnqueueWriteBuffer(context.queue(), memory, CL_TRUE, 0, values.size() * sizeof values[0],
                                       values.data(), 0, nullptr, nullptr),
              "writing repaired boundary walls to the caller's buffer");
  };
  write(to.offset, std::vector<cl_uint>(walls.offset.begin(), walls.offset.end()));
  write(to.facet, walls.facet);
  float32 ? write(to.measure, std::vector<float>(walls.measure.begin(), walls.measure.end()))
          : write(to.measure, walls.measure);
}

namespace {

constexpr std::uint32_t not_listed = ~std::uint32_t{0};

using Wall = PlacedWall;

/// The walls of listed cells by row, those of the rows of their neighbours too.
class NewWalls {
 public:
  NewWalls(std::span<const std::uint32_t> listed, const Adjacency& exact, const std::vector<bool>& has_cell)
      : listed_(listed), exact_(exact), has_cell_(has_cell), row_(has_cell.size(), not_listed) {
    const std::size_t n = has_cell.size();
    for (std::uint32_t row = 0; row < listed.size(); ++row) row_[listed[row]] = row;
    begin_.assign(n + 1, 0);
    for_each([this](std::uint32_t i, const Wall&) { ++begin_[i + 1]; });
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    walls_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for_each([&](std::uint32_t i, const Wall& wall) { walls_[next[i]++] = wall; });
    for (std::size_t i = 0; i < n; ++i)
      std::sort(walls_.begin() + static_cast<std::ptrdiff_t>(begin_[i]),
                walls_.begin() + static_cast<std::ptrdiff_t>(begin_[i + 1]));
  }

  bool is_listed(std::uint32_t seed) const { return row_[seed] != not_listed; }
  std::span<const Wall> row(std::uint32_t seed) const {
    return std::span(walls_).subspan(begin_[seed], begin_[seed + 1] - begin_[seed]);
  }

 private:
  /// Calls add(i, wall of i) for both sides of each wall.
  template <class Add>
  void for_each(const Add& add) const {
    for (const std::uint32_t i : listed_) {
      if (!has_cell_[i]) continue;
      const std::uint32_t row = row_[i];
      for (std::uint64_t k = exact_.offset[row]; k < exact_.offset[row + 1]; ++k) {
        const std::uint32_t j = exact_.neighbor[k];
        if (!has_cell_[j]) continue;
        const Shift shift = exact_.shift.empty() ? Shift{} : exact_.shift[k], back = opposite(shift);
        const double here = exact_.wall[k], *there = side_of(j, i, back);
        add(i, {j, shift, there ? (here + *there) / 2 : here});
        if (!there) add(j, {i, back, here});  // else it is added as a wall of j
      }
    }
  }

  /// The wall of a listed cell with an image of another one, or null if it is not listed or has none.
  const double* side_of(std::uint32_t cell, std::uint32_t neighbor, const Shift& shift) const {
    if (!is_listed(cell)) return nullptr;
    const auto begin = exact_.neighbor.begin() + static_cast<std::ptrdiff_t>(exact_.offset[row_[cell]]),
               end = exact_.neighbor.begin() + static_cast<std::ptrdiff_t>(exact_.offset[row_[cell] + 1]);
    for (auto at = std::lower_bound(begin, end, neighbor); at != end && *at == neighbor; ++at) {
      const auto k = static_cast<std::size_t>(at - exact_.neighbor.begin());
      if (exact_.shift.empty() || exact_.shift[k] == shift) return &exact_.wall[k];
    }
    return nullptr;
  }

  std::span<const std::uint32_t> listed_;
  const Adjacency& exact_;
  const std::vector<bool>& has_cell_;
  std::vector<std::uint32_t> row_;  // by seed: its row of `exact`
  std::vector<std::size_t> begin_;  // by seed
  std::vector<Wall> walls_;
};

template <class Real>
void append(DeviceRows<Real>& rows, const Wall& wall, Real measure) {
  rows.neighbor.push_back(wall.neighbor);
  rows.wall.push_back(measure);
  if (rows.has_shifts) rows.shift.push_back(wall.shift);
}

/// Appends the row of cell i: its walls with cells that are not listed, and those of listed ones.
template <class Real>
void append_row(const DeviceRows<Real>& all, const NewWalls& walls, std::uint32_t i,
                DeviceRows<Real>& merged) {
  const std::span<const Wall> added = walls.row(i);
  auto next = added.begin();
  const std::uint32_t end = walls.is_listed(i) ? all.offset[i] : all.offset[i + 1];
  for (std::uint32_t k = all.offset[i]; k < end; ++k) {
    if (walls.is_listed(all.neighbor[k])) continue;
    const Wall kept{all.neighbor[k], all.has_shifts ? all.shift[k] : Shift{}, 0};
    for (; next != added.end() && *next < kept; ++next)
      append(merged, *next, static_cast<Real>(next->measure));
    append(merged, kept, all.wall[k]);
  }
  for (; next != added.end(); ++next) append(merged, *next, static_cast<Real>(next->measure));
  merged.offset.push_back(static_cast<std::uint32_t>(merged.neighbor.size()));
}

}  // namespace

template <class Real>
DeviceRows<Real> merge_rows(const DeviceRows<Real>& all, std::span<const std::uint32_t> listed,
                            const Adjacency& exact, const std::vector<bool>& has_cell, std::uint32_t room) {
  const NewWalls walls(listed, exact, has_cell);
  DeviceRows<Real> merged;
  merged.has_shifts = all.has_shifts;
  merged.offset.reserve(all.offset.size());
  merged.neighbor.reserve(all.neighbor.size());
  merged.wall.reserve(all.wall.size());
  merged.offset.push_back(0);
  for (std::uint32_t i = 0; i < has_cell.size(); ++i) append_row(all, walls, i, merged);
  if (merged.neighbor.size() > room)
    throw Error(ErrorCode::invalid_argument,
                "the repaired adjacency has " + std::to_string(merged.neighbor.size()) +
                    " entries, and the buffers of neighbors and walls have room for " + std::to_string(room) +
                    "; enqueue the diagram again with larger ones, and repair that");
  return merged;
}

template DeviceRows<float> merge_rows(const DeviceRows<float>&, std::span<const std::uint32_t>,
                                      const Adjacency&, const std::vector<bool>&, std::uint32_t);
template DeviceRows<double> merge_rows(const DeviceRows<double>&, std::span<const std::uint32_t>,
                                       const Adjacency&, const std::vector<bool>&, std::uint32_t);

}  // namespace powercell
