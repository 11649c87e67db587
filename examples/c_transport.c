/* Weights for cells of given masses, of a density that is a function of the program; then the seeds move. */
#include <math.h>

#include "c_check.h"

/* Mass per unit of area; several threads call it at a time. */
static int density_at(const double* point, double* value, void* user) {
  const double* slope = user;
  *value = 1 + *slope * point[0];
  return 1; /* 0 would stop the transport */
}

static int print_step(const pc_transport_step* step, void* user) {
  (void)user;
  printf("step %d, %s: error %.1e\n", step->step, pc_transport_phase_name(step->phase), step->error);
  return 1;
}

int main(void) {
  const double low[] = {0, 0}, high[] = {1, 1};
  const double positions[] = {0.2, 0.3, 0.7, 0.2, 0.5, 0.8}, moved[] = {0.25, 0.3, 0.7, 0.25, 0.5, 0.75};
  const double shares[] = {1, 2, 3};
  enum { n = 3 };
  double slope = 2;
  pc_device* device = NULL;
  pc_domain* domain = NULL;
  pc_density* density = NULL;
  pc_transport_solver* solver = NULL;
  pc_transport_options options;
  const pc_transport_result* result = NULL;
  size_t i;

  CHECK(pc_device_create(NULL, &device));
  CHECK(pc_domain_box(low, high, 2, &domain));
  CHECK(pc_density_function(density_at, &slope, 0, &density));
  CHECK(pc_transport_options_init(&options, sizeof options));
  options.density = density;
  options.rescale = 1; /* shares of the domain's mass, which is 2 */
  options.progress = print_step;
  CHECK(pc_transport_solver_create(device, domain, &options, &solver));
  CHECK(pc_transport_solver_set_seeds(solver, positions, NULL, n));
  CHECK(pc_transport_solver_set_masses(solver, shares, n));
  CHECK(pc_transport_solver_solve(solver, NULL));
  CHECK(pc_transport_solver_move_seeds(solver, moved, n));
  CHECK(pc_transport_solver_solve(solver, &result));

  for (i = 0; i < n; ++i) {
    printf("cell %lu: weight %+.6f, mass %.6f\n", (unsigned long)i, result->weights[i], result->mass[i]);
    if (fabs(result->mass[i] - shares[i] / 3) > 1e-5) return 1;
  }
  printf("%s, total mass %.6f\n", result->converged ? "converged" : "not converged", result->total_mass);
  if (!result->converged || fabs(result->primal - result->dual) > 1e-6) return 1;

  pc_transport_result_destroy(result);
  pc_transport_solver_destroy(solver);
  pc_density_destroy(density);
  pc_domain_destroy(domain);
  pc_device_destroy(device);
  return 0;
}
