#include <powercell/c/local_diagram.h>

#include <optional>
#include <powercell/local_diagram.hpp>

#include "lib/c_api/communicator.hpp"
#include "lib/c_api/distributed.hpp"
#include "lib/c_api/handles.hpp"
#include "lib/c_api/options.hpp"

namespace powercell::c_api {
namespace {

/// What a pc_local_diagram points into.
struct OwnedLocalDiagram {
  explicit OwnedLocalDiagram(LocalDiagram from) : made(std::move(from)) {}
  LocalDiagram made;
  std::optional<pc_diagram> handle;  // of `made.diagram`, once that stays where it is
};

void fill_local_diagram(pc_local_diagram& to, OwnedLocalDiagram& from) {
  to.diagram = &from.handle.emplace(from.made.diagram);
  to.id_count = from.made.ids.size();
  to.ids = pointer(from.made.ids);
  to.cell_count = from.made.cells.size();
  to.cells = pointer(from.made.cells);
}

/// The arguments of a call on one rank.
struct LocalDiagramCall {
  const Device& device;
  const Domain& domain;
  std::span<const std::uint64_t> ids;
  SeedsView seeds;
  const DistributedCells& cells;
  Options options;
};

}  // namespace
}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

pc_status pc_local_diagram_create(const pc_communicator* communicator, const pc_device* device,
                                  const pc_domain* domain, const uint64_t* ids, const double* positions,
                                  const double* weights, size_t count, const pc_distributed_cells* cells,
                                  const pc_options* options, const pc_local_diagram** local) {
  return guarded([&] {
    CallerCommunicator ranks(communicator);
    const auto call = read_on_all(ranks, [&] {
      (void)result_at(local);
      const Domain& in = domain_in(domain);
      return LocalDiagramCall{device_in(device),       in,
                              view(ids, count, "ids"), seeds_of(in.dimension(), positions, weights, count),
                              cells_in(cells),         options_of(options)};
    });
    hand_over_result(local,
                     OwnedLocalDiagram(local_diagram(ranks, call.device, call.domain, call.ids, call.seeds,
                                                     call.cells, call.options)),
                     fill_local_diagram);
  });
}

void pc_local_diagram_destroy(const pc_local_diagram* local) {
  destroy_result<OwnedLocalDiagram>(local);
}
