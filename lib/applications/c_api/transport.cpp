#include <powercell/c/transport.h>

#include <powercell/transport.hpp>

#include "lib/applications/c_api/density.hpp"
#include "lib/c_api/handles.hpp"
#include "lib/c_api/options.hpp"
#include "lib/c_api/results.hpp"

struct pc_transport_solver {
  explicit pc_transport_solver(powercell::TransportSolver made, int of_dimension)
      : solver(std::move(made)), dimension(of_dimension) {}
  powercell::TransportSolver solver;
  int dimension;
  std::unique_ptr<pc_diagram> diagram;  // of the last solve, once it was asked for
};

namespace powercell::c_api {
namespace {

static_assert(static_cast<int>(LinearSolver::multilevel) == PC_LINEAR_MULTILEVEL);
static_assert(static_cast<int>(TransportPhase::ascent) == PC_PHASE_ASCENT);

struct Transport {
  TransportResult result;
  int dimension;
  std::vector<pc_transport_step> steps;
  std::vector<const pc_transport_step*> pointers;
};

pc_transport_step view_of(const TransportStep& from) {
  pc_transport_step to{};
  to.step = from.step;
  to.phase = static_cast<pc_transport_phase>(from.phase);
  to.exponent = from.exponent;
  to.spread = from.spread;
  to.error = from.error;
  to.gradient = from.gradient;
  to.least = from.least;
  to.empty = from.empty;
  to.dual = from.dual;
  to.length = from.length;
  to.diagrams = from.diagrams;
  to.linear = static_cast<pc_linear_solver>(from.linear);
  to.linear_iterations = from.linear_iterations;
  to.linear_residual = from.linear_residual;
  to.diagram_seconds = from.diagram_seconds;
  to.linear_seconds = from.linear_seconds;
  return to;
}

void fill(pc_transport_result& to, Transport& of) {
  const TransportResult& from = of.result;
  for (const TransportStep& step : from.steps) of.steps.push_back(view_of(step));
  of.pointers = pointers(of.steps);
  to.count = from.weights.size();
  to.dimension = of.dimension;
  to.converged = from.converged;
  to.error = from.error;
  to.quadrature_error = from.quadrature_error;
  to.rounding_error = from.rounding_error;
  to.tolerance = from.tolerance;
  to.weights = pointer(from.weights);
  to.target = pointer(from.target);
  to.mass = pointer(from.mass);
  to.centroid = pointer(from.centroid);
  to.second_moment = pointer(from.second_moment);
  to.merged_with = pointer(from.merged_with);
  to.merged = from.merged;
  to.total_mass = from.total_mass;
  to.primal = from.primal;
  to.dual = from.dual;
  to.step_count = of.pointers.size();
  to.steps = pointer(of.pointers);
  to.newton_steps = from.newton_steps();
  to.diagrams = from.diagrams;
}

pc_transport_options defaults() {
  const TransportOptions from;
  pc_transport_options to{};
  to.max_steps = from.max_steps;
  to.linear_residual = from.linear_residual;
  return to;
}

TransportOptions transport_options(const pc_transport_options* options) {
  const pc_transport_options from = current(options, defaults(), "pc_transport_options");
  TransportOptions to;
  to.density = density_or_one(from.density);
  to.periodic = from.periodic != 0;
  to.tolerance = from.tolerance;
  to.max_steps = from.max_steps;
  to.linear = value_of<LinearSolver>(from.linear, PC_LINEAR_MULTILEVEL, "options.linear", "pc_linear_solver");
  to.linear_residual = from.linear_residual;
  to.rescale = from.rescale != 0;
  to.diagram = options_of(from.diagram);
  if (from.progress)
    to.progress = [call = from.progress, user = from.progress_user](const TransportStep& step) {
      const pc_transport_step view = view_of(step);
      return call_back("the progress function", [&] { return call(&view, user); }) != 0;
    };
  return to;
}

pc_transport_solver& solver_in(pc_transport_solver* handle) {
  return checked(handle, "solver");
}

/// The solver of a handle, before a call that sets what its diagram depends on.
TransportSolver& changing(pc_transport_solver* handle) {
  solver_in(handle).diagram.reset();
  return handle->solver;
}

}  // namespace

}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

extern "C" {

const char* pc_linear_solver_name(pc_linear_solver solver) {
  const int number = number_in(solver);
  const bool known = number >= PC_LINEAR_AUTOMATIC && number <= PC_LINEAR_MULTILEVEL;
  return known ? name(static_cast<LinearSolver>(number)) : "unknown";
}

const char* pc_transport_phase_name(pc_transport_phase phase) {
  const int number = number_in(phase);
  const bool known = number >= PC_PHASE_START && number <= PC_PHASE_ASCENT;
  return known ? name(static_cast<TransportPhase>(number)) : "unknown";
}

pc_status pc_transport_options_init(pc_transport_options* options, size_t struct_size) {
  return init(options, struct_size, defaults(), "pc_transport_options");
}

pc_status pc_transport(const pc_device* device, const pc_domain* domain, const double* positions,
                       const double* weights, size_t count, const double* masses,
                       const pc_transport_options* options, const pc_transport_result** result) {
  return guarded([&] {
    result_at(result);
    const Domain& in = domain_in(domain);
    const SeedsView seeds = seeds_of(in.dimension(), positions, weights, count);
    TransportResult solved =
        transport(device_in(device), in, seeds, optional_view(masses, count), transport_options(options));
    hand_over_result(result, Transport{std::move(solved), in.dimension(), {}, {}}, fill);
  });
}

void pc_transport_result_destroy(const pc_transport_result* result) {
  destroy_result<Transport>(result);
}

pc_status pc_transport_solver_create(const pc_device* device, const pc_domain* domain,
                                     const pc_transport_options* options, pc_transport_solver** solver) {
  return guarded([&] {
    result_at(solver);
    const Domain& in = domain_in(domain);
    hand_over(solver, TransportSolver(device_in(device), in, transport_options(options)), in.dimension());
  });
}

void pc_transport_solver_destroy(pc_transport_solver* solver) {
  delete solver;
}

pc_status pc_transport_solver_set_seeds(pc_transport_solver* solver, const double* positions,
                                        const double* weights, size_t count) {
  return guarded([&] {
    TransportSolver& target = changing(solver);
    target.set_seeds(seeds_of(solver->dimension, positions, weights, count));
  });
}

pc_status pc_transport_solver_move_seeds(pc_transport_solver* solver, const double* positions, size_t count) {
  return guarded([&] {
    TransportSolver& target = changing(solver);
    target.move_seeds(positions_of(solver->dimension, positions, count));
  });
}

pc_status pc_transport_solver_set_weights(pc_transport_solver* solver, const double* weights, size_t count) {
  return guarded([&] { solver_in(solver).solver.set_weights(view(weights, count, "weights")); });
}

pc_status pc_transport_solver_set_masses(pc_transport_solver* solver, const double* masses, size_t count) {
  return guarded([&] { solver_in(solver).solver.set_masses(view(masses, count, "masses")); });
}

pc_status pc_transport_solver_set_tolerance(pc_transport_solver* solver, double tolerance) {
  return guarded([&] { solver_in(solver).solver.set_tolerance(tolerance); });
}

pc_status pc_transport_solver_set_max_steps(pc_transport_solver* solver, int steps) {
  return guarded([&] { solver_in(solver).solver.set_max_steps(steps); });
}

pc_status pc_transport_solver_solve(pc_transport_solver* solver, const pc_transport_result** result) {
  return guarded([&] {
    const TransportResult& solved = changing(solver).solve();
    if (result) hand_over_result(result, Transport{solved, solver->dimension, {}, {}}, fill);
  });
}

pc_status pc_transport_solver_result(const pc_transport_solver* solver, const pc_transport_result** result) {
  return guarded([&] {
    result_at(result);
    const pc_transport_solver& of = checked(solver, "solver");
    hand_over_result(result, Transport{of.solver.result(), of.dimension, {}, {}}, fill);
  });
}

pc_status pc_transport_solver_diagram(pc_transport_solver* solver, pc_diagram** diagram) {
  return guarded([&] {
    result_at(diagram);
    Diagram& of = solver_in(solver).solver.diagram();
    if (!solver->diagram) solver->diagram = std::make_unique<pc_diagram>(of);
    *diagram = solver->diagram.get();
  });
}

}  // extern "C"
