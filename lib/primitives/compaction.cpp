#include "lib/primitives/compaction.hpp"

namespace powercell {

Compaction::Compaction(const std::shared_ptr<cl::Context>& context)
    : mark_(context, context->program("primitives/compact.cl", {}), "mark_wanted"),
      list_(context, context->program("primitives/compact.cl", {}), "list_marked"),
      scan_(context, ExclusiveScan::Type::uint32),
      places_(context) {}

void Compaction::enqueue(cl_mem values, std::uint32_t count, std::uint32_t wanted, cl_mem indices,
                         std::uint32_t room, cl_mem found, std::size_t local, cl_event* done) {
  const std::size_t places = std::size_t{count} + 1;
  places_.reserve(places * sizeof(cl_uint));
  mark_.args(count, values, wanted, places_).submit(places, local);
  scan_.enqueue(places_.handle(), count + 1, local);
  list_.args(count, places_, room, indices, found).submit(places, local, done);
}

}  // namespace powercell
