#include "lib/seeds/device_wrap.hpp"

#include <cmath>

namespace powercell {
namespace {

/// The numbers of the lattice with those of the frame.
PeriodGrid::Numbers numbers_in(const Frame& frame, const Period& period) {
  PeriodGrid::Numbers numbers = period.grid().numbers();
  for (std::size_t c = 0; c < 3; ++c) {
    if (numbers[PERIOD_ROUNDED + c] == 0) continue;
    const auto quantum = static_cast<int>(numbers[PERIOD_QUANTUM + c]);
    // The corners of the room around all cells are multiples of the quantum, so its centre is one of the
    // half.
    numbers[PERIOD_CENTRE + c] = static_cast<std::int64_t>(std::ldexp(frame.centre[c], 1 - quantum));
    numbers[PERIOD_UNIT + c] = quantum - 1 + std::ilogb(frame.scale);
  }
  return numbers;
}

}  // namespace

DeviceWrap::DeviceWrap(const std::shared_ptr<cl::Context>& context, const std::vector<std::string>& defines,
                       const Period& lattice, const Frame& host_frame)
    : period(context),
      place(context),
      shift(context),
      dimension_(static_cast<std::size_t>(lattice.dimension())),
      wrap_(context, context->program("seeds/wrap.cl", defines), "wrap_seeds") {
  period.upload(numbers_in(host_frame, lattice));
}

void DeviceWrap::enqueue(cl_mem frame, cl_mem positions, cl_mem weights, std::uint32_t count, cl_mem packed,
                         cl_mem status) {
  place.resize(count * dimension_);
  shift.resize(std::size_t{count} * 3);
  wrap_
      .args(count, frame, positions, weights ? weights : positions, cl_int{weights != nullptr}, period,
            packed, status, place, shift)
      .submit(count);
}

}  // namespace powercell
