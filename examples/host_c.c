/* Cells and neighbours of a few weighted seeds in the unit cube, from C. */
#include <math.h>
#include <stdlib.h>

#include "c_check.h"

int main(void) {
  const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
  const double positions[5 * 3] = {.2, .2, .2, .8, .3, .2, .3, .8, .4, .6, .6, .8, .5, .5, .5};
  const double weights[5] = {0, .01, 0, .04, .02}; /* squared lengths */
  enum { n = 5 };
  double volume[n];
  double total = 0;
  uint64_t offset[n + 1];
  uint32_t* neighbor = NULL;
  double* wall = NULL;
  size_t count = 0, i, k;
  pc_device* device = NULL;
  pc_domain* domain = NULL;
  pc_diagram* diagram = NULL;

  CHECK(pc_device_create(NULL, &device));
  CHECK(pc_domain_box(low, high, 3, &domain));
  CHECK(pc_diagram_create(device, domain, NULL, &diagram));
  CHECK(pc_diagram_set_seeds(diagram, positions, weights, n));
  CHECK(pc_diagram_measures(diagram, volume, NULL, NULL, NULL));

  CHECK(pc_diagram_adjacency(diagram, NULL, NULL, NULL, &count)); /* the number of entries */
  neighbor = malloc((count + 1) * sizeof *neighbor);
  wall = malloc((count + 1) * sizeof *wall);
  if (!neighbor || !wall) return 1;
  CHECK(pc_diagram_adjacency(diagram, offset, neighbor, wall, &count));

  for (i = 0; i < n; ++i) {
    printf("cell %zu: volume %.6f, walls", i, volume[i]);
    for (k = offset[i]; k < offset[i + 1]; ++k) printf(" %u (%.4f)", (unsigned)neighbor[k], wall[k]);
    printf("\n");
    total += volume[i];
  }
  printf("on %s: sum of volumes %.15f\n", pc_device_name(device), total);

  free(neighbor);
  free(wall);
  pc_diagram_destroy(diagram);
  pc_domain_destroy(domain);
  pc_device_destroy(device);
  return fabs(total - 1) < 1e-5 ? 0 : 1;
}
