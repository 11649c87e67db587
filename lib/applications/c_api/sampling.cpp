#include <powercell/c/sampling.h>

#include <powercell/sampling.hpp>

#include "lib/applications/c_api/density.hpp"
#include "lib/c_api/handles.hpp"
#include "lib/c_api/options.hpp"
#include "lib/c_api/results.hpp"

namespace powercell::c_api {
namespace {

static_assert(static_cast<int>(SamplingMode::quantise) == PC_SAMPLING_QUANTISE);
static_assert(static_cast<int>(SamplingDescent::lbfgs) == PC_DESCENT_LBFGS);

struct Samples {
  SamplingResult result;
  int dimension;
  std::vector<pc_sampling_step> steps;
  std::vector<const pc_sampling_step*> pointers;
};

pc_sampling_step view_of(const SamplingStep& from) {
  pc_sampling_step to{};
  to.iteration = from.iteration;
  to.newton_steps = from.newton_steps;
  to.energy = from.energy;
  to.gradient = from.gradient;
  to.hexatic = from.hexatic;
  to.capacity_error = from.capacity_error;
  to.seconds = from.seconds;
  return to;
}

void fill(pc_sampling_result& to, Samples& of) {
  const SamplingResult& from = of.result;
  for (const SamplingStep& step : from.steps) of.steps.push_back(view_of(step));
  of.pointers = pointers(of.steps);
  to.count = from.mass.size();
  to.dimension = of.dimension;
  to.converged = from.converged;
  to.positions = pointer(from.positions);
  to.weights = pointer(from.weights);
  to.mass = pointer(from.mass);
  to.capacity_error = from.capacity_error;
  to.quadrature_error = from.quadrature_error;
  to.energy = from.energy;
  to.relative_energy = from.relative_energy;
  to.apart_cells = from.apart.cells;
  to.apart_share = from.apart.share;
  to.apart_distance = from.apart.distance;
  to.layer_count = from.layers.size();
  to.layers = pointer(from.layers);
  to.layer_least = from.layer_spacing.least;
  to.layer_mean = from.layer_spacing.mean;
  to.layer_hexatic = from.layer_spacing.hexatic;
  to.step_count = of.pointers.size();
  to.steps = pointer(of.pointers);
}

pc_sampling_options defaults() {
  const SamplingOptions from;
  pc_sampling_options to{};
  to.hexatic = from.hexatic;
  to.movement = from.movement;
  to.capacity_tolerance = from.capacity_tolerance;
  to.random_seed = from.random_seed;
  return to;
}

SamplingOptions sampling_options(const pc_sampling_options* options) {
  const pc_sampling_options from = current(options, defaults(), "pc_sampling_options");
  SamplingOptions to;
  to.density = density_or_one(from.density);
  to.mode = value_of<SamplingMode>(from.mode, PC_SAMPLING_QUANTISE, "options.mode", "pc_sampling_mode");
  to.descent =
      value_of<SamplingDescent>(from.descent, PC_DESCENT_LBFGS, "options.descent", "pc_sampling_descent");
  to.periodic = from.periodic != 0;
  to.iterations = from.iterations;
  to.hexatic = from.hexatic;
  to.movement = from.movement;
  to.capacity_tolerance = from.capacity_tolerance;
  to.random_seed = from.random_seed;
  to.diagram = options_of(from.diagram);
  if (from.progress)
    to.progress = [call = from.progress, user = from.progress_user](const SamplingStep& step) {
      const pc_sampling_step view = view_of(step);
      return call_back("the progress function", [&] { return call(&view, user); }) != 0;
    };
  return to;
}

void hand_over_samples(const pc_sampling_result** out, SamplingResult result, const Domain& domain) {
  hand_over_result(out, Samples{std::move(result), domain.dimension(), {}, {}}, fill);
}

}  // namespace

}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

extern "C" {

pc_status pc_sampling_options_init(pc_sampling_options* options, size_t struct_size) {
  return init(options, struct_size, defaults(), "pc_sampling_options");
}

pc_status pc_sample(const pc_device* device, const pc_domain* domain, size_t count,
                    const pc_sampling_options* options, const pc_sampling_result** result) {
  return guarded([&] {
    result_at(result);
    const Domain& in = domain_in(domain);
    hand_over_samples(result, sample(device_in(device), in, count, sampling_options(options)), in);
  });
}

pc_status pc_sample_from(const pc_device* device, const pc_domain* domain, const double* positions,
                         size_t count, const pc_sampling_options* options,
                         const pc_sampling_result** result) {
  return guarded([&] {
    result_at(result);
    const Domain& in = domain_in(domain);
    const std::span<const double> start = positions_of(in.dimension(), positions, count);
    hand_over_samples(result, sample(device_in(device), in, start, sampling_options(options)), in);
  });
}

void pc_sampling_result_destroy(const pc_sampling_result* result) {
  destroy_result<Samples>(result);
}

}  // extern "C"
