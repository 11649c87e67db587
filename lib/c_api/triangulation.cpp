#include <powercell/c/triangulation.h>

#include <memory>
#include <powercell/triangulation.hpp>

#include "lib/c_api/handles.hpp"
#include "lib/c_api/options.hpp"
#include "lib/c_api/results.hpp"

using namespace powercell;
using namespace powercell::c_api;

extern "C" {

pc_status pc_triangulation_create(const pc_device* device, int dimension, const double* positions,
                                  const double* weights, size_t count, const pc_options* options,
                                  const pc_triangulation** triangulation) {
  return guarded([&] {
    result_at(triangulation);
    coordinates(dimension);
    const SeedsView seeds = seeds_of(dimension, positions, weights, count);
    hand_over_result(triangulation, regular_triangulation(device_in(device), seeds, options_of(options)),
                     [](pc_triangulation& to, const Dual& from) { to.dual = view_of(from); });
  });
}

void pc_triangulation_destroy(const pc_triangulation* triangulation) {
  destroy_result<Dual>(triangulation);
}

}  // extern "C"
