/* One seed of the hexagonal lattice: its cell has six walls, all with images of itself. */
#include <math.h>

#include "c_check.h"

int main(void) {
  const double root = sqrt(3.0);
  double vectors[4]; /* two rows */
  const double positions[] = {0.1, 0.2};
  pc_device* device = NULL;
  pc_domain* domain = NULL;
  pc_diagram* diagram = NULL;
  const pc_domain_info* info = NULL;
  const pc_measures* measures = NULL;
  const pc_adjacency* adjacency = NULL;
  const pc_cells* cells = NULL;
  double around = 0;
  uint64_t k;

  vectors[0] = 1;
  vectors[1] = 0;
  vectors[2] = 0.5;
  vectors[3] = root / 2;
  CHECK(pc_device_create(NULL, &device));
  CHECK(pc_domain_lattice(vectors, NULL, 2, &domain));
  CHECK(pc_domain_info_view(domain, &info));
  CHECK(pc_diagram_create(device, domain, NULL, &diagram));
  CHECK(pc_diagram_set_seeds(diagram, positions, NULL, 1));
  CHECK(pc_diagram_compute(diagram, 1, 1));
  CHECK(pc_diagram_measures_view(diagram, &measures));
  CHECK(pc_diagram_adjacency_view(diagram, &adjacency));
  CHECK(pc_diagram_cells_view(diagram, &cells));

  printf("area %.6f in %lu piece\n", measures->mass[0], (unsigned long)cells->piece_count);
  for (k = adjacency->offset[0]; k < adjacency->offset[1]; ++k) {
    const int32_t* shift = adjacency->shift + 3 * k;
    const double x = shift[0] * info->periods[0][0] + shift[1] * info->periods[1][0];
    const double y = shift[0] * info->periods[0][1] + shift[1] * info->periods[1][1];
    printf("wall %.6f with seed %lu moved by (%+.3f, %+.3f)\n", adjacency->wall[k],
           (unsigned long)adjacency->neighbor[k], x, y);
    if (fabs(x * x + y * y - 1) > 1e-9) return 1; /* all images are one period away */
    around += adjacency->wall[k];
  }
  printf("%lu walls, %.6f around\n", (unsigned long)adjacency->entry_count, around);

  if (adjacency->entry_count != 6 || fabs(around - 6 / root) > 1e-5 ||
      fabs(measures->mass[0] - root / 2) > 1e-5)
    return 1;
  pc_diagram_destroy(diagram);
  pc_domain_destroy(domain);
  pc_device_destroy(device);
  return 0;
}
