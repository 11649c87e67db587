#include <powercell/c/out_of_core.h>

#include <algorithm>
#include <powercell/out_of_core.hpp>

#include "lib/c_api/handles.hpp"
#include "lib/c_api/options.hpp"
#include "lib/c_api/results.hpp"

namespace powercell::c_api {
namespace {

pc_out_of_core_options defaults_out_of_core() {
  const OutOfCoreOptions from;
  pc_out_of_core_options to{};
  to.memory = from.memory;
  to.piece_seeds = from.piece_seeds;
  return to;
}

std::string text_or_none(const char* text) {
  return text ? text : "";
}

OutOfCoreOptions out_of_core_options(const pc_out_of_core_options* options) {
  const pc_out_of_core_options from = current(options, defaults_out_of_core(), "pc_out_of_core_options");
  OutOfCoreOptions to;
  to.diagram = options_of(from.diagram);
  to.folder = text_or_none(from.folder);
  to.memory = from.memory;
  to.walls = from.walls != 0;
  to.piece_seeds = from.piece_seeds;
  return to;
}

SeedSource source_of(const pc_seed_source* given) {
  const pc_seed_source from = current(&checked(given, "source"), pc_seed_source{}, "pc_seed_source");
  SeedSource to{from.count, from.dimension, text_or_none(from.name), {}};
  if (from.read)
    to.read = [read = from.read, user = from.user](std::uint64_t first, std::span<double> positions,
                                                   std::span<double> weights) {
      constexpr const char* name = "the function that reads seeds";
      std::fill(weights.begin(), weights.end(), 0.0);
      require_went_on(
          call_back(name,
                    [&] { return read(first, weights.size(), positions.data(), weights.data(), user); }),
          name);
    };
  return to;
}

void give(const CellRows& from, pc_take_cells take, void* user) {
  constexpr const char* name = "the function that takes cells";
  const pc_measures measures = view_of(from.measures);
  const pc_cell_rows rows{
      from.first,         &measures,           pointer(from.offset), pointer(from.neighbor),
      pointer(from.wall), pointer(from.shift), from.all_walls};
  require_went_on(call_back(name, [&] { return take(&rows, user); }), name);
}

void fill_report(pc_out_of_core_report& to, const OutOfCoreReport& from) {
  to.cells = from.cells;
  to.hidden = from.hidden;
  to.duplicate = from.duplicate;
  to.measure = from.measure;
  to.domain_measure = from.domain_measure;
  to.pieces = from.pieces;
  to.kept = from.kept;
  to.again = from.again;
  to.rounds = from.rounds;
  to.fetched = from.fetched;
  to.neighbors = from.neighbors;
  to.clipped = from.clipped;
  to.bytes_read = from.bytes_read;
  to.bytes_written = from.bytes_written;
  to.sort = from.sort;
  to.compute = from.compute;
  to.gather = from.gather;
}

}  // namespace
}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

pc_status pc_seed_source_init(pc_seed_source* source, size_t struct_size) {
  return init(source, struct_size, pc_seed_source{}, "pc_seed_source");
}

pc_status pc_out_of_core_options_init(pc_out_of_core_options* options, size_t struct_size) {
  return init(options, struct_size, defaults_out_of_core(), "pc_out_of_core_options");
}

pc_status pc_compute_out_of_core(const pc_device* device, const pc_domain* domain,
                                 const pc_seed_source* source, pc_take_cells take, void* user,
                                 const pc_out_of_core_options* options,
                                 const pc_out_of_core_report** report) {
  return guarded([&] {
    (void)result_at(report);  // before the work of hours
    require(take != nullptr, "take is NULL");
    const auto use = [&](const CellRows& rows) { give(rows, take, user); };
    const OutOfCoreReport made = compute_out_of_core(device_in(device), domain_in(domain), source_of(source),
                                                     use, out_of_core_options(options));
    hand_over_result(report, made, fill_report);
  });
}

void pc_out_of_core_report_destroy(const pc_out_of_core_report* report) {
  destroy_result<OutOfCoreReport>(report);
}
