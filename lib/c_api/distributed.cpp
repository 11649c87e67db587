#include "lib/c_api/distributed.hpp"

#include "lib/c_api/communicator.hpp"
#include "lib/c_api/handles.hpp"
#include "lib/c_api/options.hpp"

namespace powercell::c_api {
namespace {

pc_exchange_report exchange_report_of(const ExchangeReport& from) {
  return {static_cast<std::uint64_t>(from.rounds),
          from.fetched,
          from.neighbors,
          from.clipped,
          from.vertices,
          from.outlines,
          from.requests,
          from.replies,
          from.ending,
          from.redistributed};
}

void fill_cells(pc_distributed_cells& to, CellsOfRank& from) {
  const DistributedCells& cells = from.cells;
  from.measures = view_of(cells.measures);
  from.report = exchange_report_of(cells.report);
  to.count = cells.measures.mass.size();
  to.entry_count = cells.neighbor.size();
  to.measures = &from.measures;
  to.offset = pointer(cells.offset);
  to.neighbor = pointer(cells.neighbor);
  to.wall = pointer(cells.wall);
  to.shift = pointer(cells.shift);
  to.report = &from.report;
}

DistributedOptions distributed_options(const pc_distributed_options* options) {
  const pc_distributed_options from = current(options, pc_distributed_options{}, "pc_distributed_options");
  return {options_of(from.diagram), from.redistribute != 0};
}

/// The arguments of a call on one rank.
struct DistributedCall {
  const Device& device;
  const Domain& domain;
  std::span<const std::uint64_t> ids;
  SeedsView seeds;
  DistributedOptions options;
};

}  // namespace

void hand_over_cells(const pc_distributed_cells** out, DistributedCells cells) {
  hand_over_result(out, CellsOfRank{std::move(cells)}, fill_cells);
}

const DistributedCells& cells_in(const pc_distributed_cells* cells) {
  return static_cast<const Result<pc_distributed_cells, CellsOfRank>&>(checked(cells, "cells")).owned.cells;
}

}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

pc_status pc_distributed_options_init(pc_distributed_options* options, size_t struct_size) {
  return init(options, struct_size, pc_distributed_options{}, "pc_distributed_options");
}

pc_status pc_compute_distributed(const pc_communicator* communicator, const pc_device* device,
                                 const pc_domain* domain, const uint64_t* ids, const double* positions,
                                 const double* weights, size_t count, const pc_distributed_options* options,
                                 const pc_distributed_cells** cells) {
  return guarded([&] {
    CallerCommunicator ranks(communicator);
    const auto call = read_on_all(ranks, [&] {
      (void)result_at(cells);
      const Domain& in = domain_in(domain);
      return DistributedCall{device_in(device), in, view(ids, count, "ids"),
                             seeds_of(in.dimension(), positions, weights, count),
                             distributed_options(options)};
    });
    hand_over_cells(cells,
                    compute_distributed(ranks, call.device, call.domain, call.ids, call.seeds, call.options));
  });
}

void pc_distributed_cells_destroy(const pc_distributed_cells* cells) {
  destroy_result<CellsOfRank>(cells);
}
