#include "lib/device_diagram/repair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <powercell/regions.hpp>
#include <string>
#include <utility>

#include "kernels/layout.h"
#include "lib/base/threads.hpp"
#include "lib/cl/transfers.hpp"
#include "lib/device_diagram/repair_cells.hpp"
#include "lib/diagram/state.hpp"

namespace powercell {
namespace {

constexpr auto invalid = static_cast<cl_uint>(DeviceSeedStatus::invalid),
               duplicate = static_cast<cl_uint>(DeviceSeedStatus::duplicate);

Options repairing(Options options) {
  options.decisions = Decisions::exact;
  options.certify = false;  // for all cells alone
  return options;
}

/// One number of a buffer. Waits.
cl_uint read_number(const std::shared_ptr<cl::Context>& context, cl_mem memory, std::size_t at) {
  cl_uint value = 0;
  cl::check(cl::clEnqueueReadBuffer(context->queue(), memory, CL_TRUE, at * sizeof value, sizeof value,
                                    &value, 0, nullptr, nullptr),
            "reading a number from the caller's buffer");
  context->check_writes();
  return value;
}

template <class T>
void write(const cl::Context& context, cl_mem memory, const std::vector<T>& values) {
  if (values.empty()) return;
  cl::check(cl::clEnqueueWriteBuffer(context.queue(), memory, CL_TRUE, 0, values.size() * sizeof(T),
                                     values.data(), 0, nullptr, nullptr),
            "writing repaired results to the caller's buffer");
}

/// The seeds of a Diagram with the numbers that they have on the device. Invalid ones become duplicates of
/// the first valid one, lighter than it, so that they affect nothing.
struct Seeds {
  std::vector<double> positions, weights;

  template <class Real>
  Seeds(const std::vector<Real>& position, const std::vector<Real>& weight, std::size_t d,
        const std::vector<cl_uint>& status)
      : positions(position.begin(), position.end()), weights(weight.begin(), weight.end()) {
    const auto valid = std::find_if(status.begin(), status.end(), [](cl_uint s) { return s != invalid; });
    if (valid == status.end()) return;
    const auto first = static_cast<std::size_t>(valid - status.begin());
    for (std::size_t i = 0; i < status.size(); ++i) {
      if (status[i] != invalid) continue;
      std::copy_n(&positions[first * d], d, &positions[i * d]);
      weights[i] = std::nextafter(weights[first], -std::numeric_limits<double>::infinity());
    }
  }
};

/// Whether the device has set aside the duplicates of the diagram, and no other seeds.
bool has_duplicates(const std::vector<cl_uint>& status, const Diagram& diagram) {
  std::vector<bool> aside(status.size());
  for (const std::uint32_t i : diagram.state().input->seeds.duplicate) aside[i] = true;
  for (std::size_t i = 0; i < status.size(); ++i)
    if (aside[i] != (status[i] == invalid || status[i] == duplicate)) return false;
  return true;
}

std::vector<std::uint32_t> valid_seeds(const std::vector<cl_uint>& status) {
  std::vector<std::uint32_t> list;
  for (std::uint32_t i = 0; i < status.size(); ++i)
    if (status[i] != invalid) list.push_back(i);
  return list;
}

/// Puts the rows of a selection among those of all.
template <class Real>
void put_measures(const Measures& from, const std::vector<std::uint32_t>& list, std::vector<Real>& measures,
                  std::vector<cl_uint>& status) {
  const auto d = static_cast<std::size_t>(from.dimension);
  for (std::size_t k = 0; k < list.size(); ++k) {
    Real* row = &measures[list[k] * (2 + d)];
    row[0] = static_cast<Real>(from.mass[k]);
    for (std::size_t c = 0; c < d; ++c) row[1 + c] = static_cast<Real>(from.centroid[k * d + c]);
    row[1 + d] = static_cast<Real>(from.second_moment[k]);
    status[list[k]] = static_cast<cl_uint>(from.status[k]);
  }
}

/// Puts the integrals of a density over a selection in place of the measures of the cells that are there.
template <class Real>
void put_density(const NodalIntegrals& from, const std::vector<std::uint32_t>& list,
                 const std::vector<cl_uint>& status, std::vector<Real>& measures) {
  constexpr std::size_t d = 3;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (status[list[k]] != static_cast<cl_uint>(DeviceSeedStatus::ok)) continue;
    Real* row = &measures[list[k] * (2 + d)];
    row[0] = static_cast<Real>(from.mass[k]);
    for (std::size_t c = 0; c < d; ++c) row[1 + c] = static_cast<Real>(from.centroid[k * d + c]);
    row[1 + d] = static_cast<Real>(from.second_moment[k]);
  }
}

/// \throw Error invalid_argument if some rows have not been written for lack of room
template <class Real>
DeviceRows<Real> read_rows(const std::shared_ptr<cl::Context>& context, const DeviceAdjacency& from,
                           std::uint32_t n, std::uint32_t room) {
  const cl_uint entries = read_number(context, from.offset, n);
  if (entries > room)
    throw Error(ErrorCode::invalid_argument,
                "the adjacency has " + std::to_string(entries) +
                    " entries, and the buffers of neighbors and walls have room for " + std::to_string(room) +
                    ", so that some rows were not written; enqueue the diagram again with larger ones, and "
                    "repair that");
  DeviceRows<Real> rows;
  rows.offset.resize(std::size_t{n} + 1);
  rows.neighbor.resize(entries);
  rows.wall.resize(entries);
  rows.has_shifts = from.shift != nullptr;
  if (rows.has_shifts) rows.shift.resize(entries);
  cl::Reads reads(context);
  reads.add(from.offset, rows.offset.data(), rows.offset.size() * sizeof(cl_uint));
  reads.add(from.neighbor, rows.neighbor.data(), entries * sizeof(cl_uint));
  reads.add(from.wall, rows.wall.data(), entries * sizeof(Real));
  if (rows.has_shifts) reads.add(from.shift, rows.shift.data(), entries * sizeof(Shift));
  reads.wait();
  return rows;
}

template <class Real>
void write_rows(const cl::Context& context, const DeviceAdjacency& to, const DeviceRows<Real>& rows) {
  write(context, to.offset, rows.offset);
  write(context, to.neighbor, rows.neighbor);
  write(context, to.wall, rows.wall);
  if (rows.has_shifts) write(context, to.shift, rows.shift);
}

}  // namespace

DeviceRepair::DeviceRepair(const Device& device, const Domain& domain, Options options)
    : threads_(thread_count(options.threads)), diagram_(device, domain, repairing(std::move(options))) {}

void DeviceRepair::set_seeds(std::vector<double> positions, const std::vector<double>& weights) {
  if (positions == positions_) {
    diagram_.set_weights(weights);
    return;
  }
  positions_.clear();
  diagram_.set_seeds({diagram_.domain().dimension(), positions, weights});
  positions_ = std::move(positions);
}

std::uint32_t DeviceRepair::run(cl_mem positions, cl_mem weights, std::uint32_t n,
                                const DeviceResults& results, Rooms rooms, cl_mem density) {
  const std::shared_ptr<cl::Context>& context = diagram_.device().context();
  const cl_uint count = read_number(context, results.uncertain.count, 0);
  if (count == 0) return 0;
  if (count > rooms.uncertain)
    throw Error(ErrorCode::invalid_argument,
                std::to_string(count) + " seeds are uncertain, and their list has room for " +
                    std::to_string(rooms.uncertain) +
                    "; enqueue the diagram again with a larger list, and repair that");
  std::vector<std::uint32_t> list(count);
  cl::Reads reads(context);
  reads.add(results.uncertain.seeds, list.data(), count * sizeof(cl_uint));
  reads.wait();
  return diagram_.precision() == Precision::float32
             ? repair<float>(positions, weights, n, results, std::move(list), rooms, density)
             : repair<double>(positions, weights, n, results, std::move(list), rooms, density);
}

template <class Real>
NodalIntegrals DeviceRepair::integrals(cl_mem density, const std::vector<std::uint32_t>& list) {
  const std::size_t vertices = diagram_.domain().regions().vertices.size() / 3;
  std::vector<Real> values(vertices);
  cl::Reads reads(diagram_.device().context());
  reads.add(density, values.data(), vertices * sizeof(Real));
  reads.wait();
  std::vector<double> seeds;
  for (const std::uint32_t i : list)
    seeds.insert(seeds.end(), &positions_[3 * std::size_t{i}], &positions_[3 * std::size_t{i}] + 3);
  const double largest =
      diagram_.precision() == Precision::float32 ? LARGEST_DENSITY_FLOAT : LARGEST_DENSITY_DOUBLE;
  return integrate_nodal(diagram_.cells(), diagram_.domain(),
                         std::vector<double>(values.begin(), values.end()), largest, seeds, threads_);
}

template <class Real>
std::uint32_t DeviceRepair::repair(cl_mem positions, cl_mem weights, std::uint32_t n,
                                   const DeviceResults& results, std::vector<std::uint32_t> list,
                                   const Rooms& rooms, cl_mem density) {
  const std::shared_ptr<cl::Context>& context = diagram_.device().context();
  const auto d = static_cast<std::size_t>(diagram_.domain().dimension());
  std::vector<Real> position(n * d), weight(n), measures(n * (2 + d));
  std::vector<cl_uint> status(n);
  cl::Reads reads(context);
  reads.add(positions, position.data(), position.size() * sizeof(Real));
  if (weights) reads.add(weights, weight.data(), weight.size() * sizeof(Real));
  reads.add(results.measures, measures.data(), measures.size() * sizeof(Real));
  reads.add(results.status, status.data(), status.size() * sizeof(cl_uint));
  reads.wait();

  DeviceRows<Real> rows;
  if (wants_rows(results)) rows = read_rows<Real>(context, results.adjacency, n, rooms.rows);
  constexpr bool float32 = sizeof(Real) == sizeof(float);
  Cells cells;
  if (wants_cells(results))
    cells = read_cells(context, results.cells, n, diagram_.domain().dimension(), float32, rooms.cells);

  BoundaryWalls boundary;
  if (wants_boundary(results))
    boundary = read_boundary(context, results.boundary_walls, n, float32, rooms.boundary);

  Seeds seeds(position, weight, d, status);
  set_seeds(std::move(seeds.positions), seeds.weights);
  diagram_.select(list);
  for (const std::uint32_t i : list)
    if (status[i] == invalid)
      throw Error(ErrorCode::invalid_argument,
                  "seed " + std::to_string(i) +
                      " of the list is invalid and has no cell; give the list that enqueue() has written");
  if (!has_duplicates(status, diagram_)) {  // then other cells lack the seeds that were set aside
    list = valid_seeds(status);
    diagram_.select(list);
  }
  diagram_.compute(wants_rows(results), wants_cells(results) || density);
  put_measures(diagram_.measures(), list, measures, status);
  if (density) put_density(integrals<Real>(density, list), list, status, measures);
  if (wants_rows(results)) {
    std::vector<bool> has_cell(n);
    for (std::size_t i = 0; i < n; ++i) has_cell[i] = status[i] == static_cast<cl_uint>(SeedStatus::ok);
    rows = merge_rows(rows, list, diagram_.adjacency(), has_cell, rooms.rows);
  }
  if (wants_cells(results)) {
    cells = merge_cells(cells, list, diagram_.cells());
    require_room(cells, rooms.cells);
  }
  if (wants_boundary(results)) {
    boundary = merge_boundary(boundary, list, diagram_.boundary_walls());
    require_room(boundary, rooms.boundary);
  }
  // Nothing is written before everything is known.
  write(*context, results.measures, measures);
  write(*context, results.status, status);
  if (wants_rows(results)) write_rows(*context, results.adjacency, rows);
  if (wants_cells(results)) write_cells(*context, results.cells, cells, float32);
  if (wants_boundary(results)) write_boundary(*context, results.boundary_walls, boundary, float32);
  return static_cast<std::uint32_t>(list.size());
}

}  // namespace powercell
