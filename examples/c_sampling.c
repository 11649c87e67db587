/* Blue noise: 400 points of a density that grows towards the right, and how even they are. */
#include <math.h>
#include <stdlib.h>

#include "c_check.h"

int main(void) {
  const double low[] = {0, 0}, high[] = {1, 1};
  enum { n = 400 };
  pc_device* device = NULL;
  pc_domain* domain = NULL;
  pc_density* density = NULL;
  pc_sampling_options options;
  const pc_sampling_result* result = NULL;
  double* random_points = malloc(2 * n * sizeof *random_points);
  double even = 0, uneven = 0;
  size_t right = 0, i;

  if (!random_points) return 1;
  CHECK(pc_device_create(NULL, &device));
  CHECK(pc_domain_box(low, high, 2, &domain));
  CHECK(pc_density_formula("0.5 + x", 0, &density));
  CHECK(pc_sampling_options_init(&options, sizeof options));
  options.density = density;
  CHECK(pc_sample(device, domain, n, &options, &result));
  CHECK(pc_spacing(device, domain, result->positions, n, 0, 0, NULL, NULL, &even, NULL));
  CHECK(pc_random_points(domain, density, n, 1, random_points));
  CHECK(pc_spacing(device, domain, random_points, n, 0, 0, NULL, NULL, &uneven, NULL));

  for (i = 0; i < n; ++i) right += result->positions[2 * i] > 0.5;
  printf("%d points after %lu iterations, %lu in the right half\n", n,
         (unsigned long)(result->step_count - 1), (unsigned long)right);
  printf("masses differ by less than 0.001 %%: %s\n", result->capacity_error < 1e-5 ? "yes" : "no");
  printf("mean spacing %.2f, of random points %.2f\n", even, uneven);

  /* The right half has 5/8 of the mass. */
  if (!result->converged || labs((long)right - 250) > 10 || even < 0.7 || even < 1.3 * uneven) return 1;
  pc_sampling_result_destroy(result);
  free(random_points);
  pc_density_destroy(density);
  pc_domain_destroy(domain);
  pc_device_destroy(device);
  return 0;
}
