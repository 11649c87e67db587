#include "lib/diagram/given_seeds.hpp"

#include <algorithm>
#include <cmath>
#include <powercell/error.hpp>
#include <string>
#include <utility>

#include "lib/base/positions.hpp"
#include "lib/base/text.hpp"
#include "lib/base/threads.hpp"

namespace powercell {
namespace {

SeedFault too_large(std::size_t seed, const std::string& what, double value, bool float32) {
  return {seed, what + " is " + digits(value) + ", too large relative to the domain for " +
                    (float32 ? "single" : "double") +
                    " precision, in which its square would overflow; remove this seed" +
                    (float32 ? " or use double precision" : "")};
}

/// Squares of distances must be finite. In units of the domain's size, coordinates may be up to 1e140 and
/// weights up to 1e280, in single precision 1e17 and 1e34 (as in kernels/base/point.cl).
std::optional<InputFault> first_out_of_range(const DiagramSetup& setup, const SeedsView& seeds) {
  const Frame& frame = setup.on_device.frame();
  const auto d = static_cast<std::size_t>(seeds.dimension);
  const auto bad_position = [&](std::size_t at) {
    return !(std::abs(frame.to_device(seeds.positions[at], static_cast<int>(at % d))) <=
             frame.most_coordinate());
  };
  const auto bad_weight = [&](std::size_t i) {
    return !(std::abs(frame.weight_to_device(seeds.weights[i])) <= frame.most_weight());
  };
  const std::size_t position = first_of(seeds.positions.size(), setup.threads, bad_position);
  if (position < seeds.positions.size())
    return InputFault{1, too_large(position / d, std::string("coordinate ") + "xyz"[position % d],
                                   seeds.positions[position], frame.split)};
  const std::size_t weight = first_of(seeds.weights.size(), setup.threads, bad_weight);
  if (weight < seeds.weights.size())
    return InputFault{2, too_large(weight, "weight", seeds.weights[weight], frame.split)};
  return {};
}

void require_in_range(const DiagramSetup& setup, const SeedsView& seeds) {
  if (const auto found = first_out_of_range(setup, seeds)) refuse_seed(found->fault.seed, found->fault.why);
}

SeedRows with_room(std::size_t d, std::size_t count) {
  return {std::vector<double>(count * d), std::vector<double>(count)};
}

/// \param weights  null for zeros
void copy_row(std::size_t d, const double* positions, const double* weights, std::size_t from, SeedRows& rows,
              std::size_t to) {
  copy_point(positions + from * d, d, rows.positions.data() + to * d);
  rows.weights[to] = weights ? weights[from] : 0.0;
}

GivenSeeds make_bounded_input(const DiagramSetup& setup, const SeedsView& view) {
  const auto d = static_cast<std::size_t>(setup.domain.dimension());
  GivenSeeds input{make_seed_set(view, setup.domain.dimension(), setup.threads), {}};
  require_in_range(setup, view);
  input.duplicates = with_room(d, input.seeds.duplicate.size());
  const double* const weights = view.weights.empty() ? nullptr : view.weights.data();
  for (std::size_t k = 0; k < input.seeds.duplicate.size(); ++k)
    copy_row(d, view.positions.data(), weights, input.seeds.duplicate[k], input.duplicates, k);
  return input;
}

}  // namespace

SeedRows GivenSeeds::given() const {
  const auto d = static_cast<std::size_t>(seeds.dimension);
  SeedRows rows = with_room(d, seeds.input_count);
  for (std::size_t rank = 0; rank < seeds.size(); ++rank)
    copy_row(d, seeds.positions.data(), seeds.weights.data(), rank, rows, seeds.input[rank]);
  for (std::size_t k = 0; k < seeds.duplicate.size(); ++k)
    copy_row(d, duplicates.positions.data(), duplicates.weights.data(), k, rows, seeds.duplicate[k]);
  if (unwrapped) rows.positions = unwrapped->positions;
  return rows;
}

std::optional<InputFault> first_fault(const DiagramSetup& setup, const SeedsView& seeds) {
  if (std::optional<SeedFault> fault = first_not_finite(seeds, setup.threads))
    return InputFault{0, std::move(*fault)};
  const Period* const period = setup.domain.mesh().period.get();
  if (period == nullptr) return first_out_of_range(setup, seeds);
  std::vector<double> wrapped(seeds.positions.size());
  const std::size_t far = wrap_all(*period, seeds.positions, setup.threads, wrapped);
  if (far < seeds.size()) return InputFault{1, {far, too_far_outside}};
  return first_out_of_range(setup, {seeds.dimension, wrapped, seeds.weights});
}

GivenSeeds make_given_seeds(const DiagramSetup& setup, const SeedsView& view) {
  const Period* const period = setup.domain.mesh().period.get();
  if (period == nullptr) return make_bounded_input(setup, view);
  check_seeds(view, setup.domain.dimension(), setup.threads);
  Unwrapped unwrapped{{view.positions.begin(), view.positions.end()}, std::vector<Shift>(view.size())};
  std::vector<double> wrapped(view.positions.size());
  const std::size_t far = wrap_all(*period, view.positions, setup.threads, wrapped, unwrapped.shift);
  if (far < view.size()) refuse_far(far);
  GivenSeeds input = make_bounded_input(setup, {view.dimension, wrapped, view.weights});
  input.unwrapped = std::move(unwrapped);
  return input;
}

GivenSeeds with_weights(const DiagramSetup& setup, GivenSeeds&& input, std::span<const double> weights) {
  if (weights.size() != input.seeds.input_count)
    throw Error(ErrorCode::invalid_argument, std::to_string(weights.size()) + " weights for " +
                                                 std::to_string(input.seeds.input_count) + " seeds");
  const SeedsView view{setup.domain.dimension(), {}, weights};
  if (!input.seeds.duplicate.empty()) {
    // Of several seeds at one position, the weights decide which one is kept.
    const SeedRows given = input.given();
    return make_given_seeds(setup, {view.dimension, given.positions, weights});
  }
  check_weights(weights, setup.threads);
  require_in_range(setup, view);
  GivenSeeds next = std::move(input);
  SeedSet& seeds = next.seeds;
  parallel_for(threads_for(seeds.size(), setup.threads), seeds.size(),
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t rank = begin; rank < end; ++rank)
                   seeds.weights[rank] = weights[seeds.input[rank]];
               });
  return next;
}

}  // namespace powercell
