/* The cells of a polygon with a hole: their boundary rings, neighbours, and the facets of the domain that
 * they have. */
#include <math.h>

#include "c_check.h"

/* A square of side 4 with a square hole of side 2 in its middle. */
static const double points[] = {0, 0, 4, 0, 4, 4, 0, 4, 1, 1, 3, 1, 3, 3, 1, 3};
static const size_t ring_offset[] = {0, 4, 8};
static const size_t part_offset[] = {0, 2};

/* The area of cell i from its rings: outer ones are counter-clockwise, holes clockwise. */
static double area_of(const pc_joined_cells* cells, size_t i) {
  double area = 0;
  uint64_t face, k;
  for (face = cells->face_offset[i]; face < cells->face_offset[i + 1]; ++face) {
    const uint64_t first = cells->loop_offset[face], last = cells->loop_offset[face + 1];
    for (k = first; k < last; ++k) {
      const uint64_t next = k + 1 < last ? k + 1 : first;
      const double* a = cells->vertices + 2 * (cells->vertex_offset[i] + cells->loop[k]);
      const double* b = cells->vertices + 2 * (cells->vertex_offset[i] + cells->loop[next]);
      area += (a[0] * b[1] - a[1] * b[0]) / 2;
    }
  }
  return area;
}

int main(void) {
  const double positions[] = {0.5, 2, 3.5, 2, 2, 3.5};
  const double weights[] = {0, 0, 0.5};
  enum { n = 3 };
  pc_device* device = NULL;
  pc_domain* domain = NULL;
  pc_diagram* diagram = NULL;
  pc_options options;
  const pc_measures* measures = NULL;
  const pc_adjacency* adjacency = NULL;
  const pc_joined_cells* cells = NULL;
  const pc_boundary_walls* walls = NULL;
  double difference = 0, border = 0;
  uint64_t k;
  size_t i;

  CHECK(pc_options_init(&options, sizeof options));
  options.certify = 1; /* checks the laws of each result */
  CHECK(pc_device_create(NULL, &device));
  CHECK(pc_domain_polygon(points, ring_offset, part_offset, 1, &domain));
  CHECK(pc_diagram_create(device, domain, &options, &diagram));
  CHECK(pc_diagram_set_seeds(diagram, positions, weights, n));
  CHECK(pc_diagram_compute(diagram, 1, 1)); /* measures, adjacency and cells in one pass */
  CHECK(pc_diagram_measures_view(diagram, &measures));
  CHECK(pc_diagram_adjacency_view(diagram, &adjacency));
  CHECK(pc_diagram_joined_view(diagram, &cells));
  CHECK(pc_diagram_boundary_walls_view(diagram, &walls));

  for (i = 0; i < n; ++i) {
    const double area = area_of(cells, i);
    printf("cell %lu: area %.6f, %lu rings, neighbours", (unsigned long)i, area,
           (unsigned long)(cells->face_offset[i + 1] - cells->face_offset[i]));
    for (k = adjacency->offset[i]; k < adjacency->offset[i + 1]; ++k)
      printf(" %lu (%.4f)", (unsigned long)adjacency->neighbor[k], adjacency->wall[k]);
    printf("\n");
    difference = fmax(difference, fabs(area - measures->mass[i]));
  }
  for (k = 0; k < walls->entry_count; ++k) border += walls->measure[k];
  printf("total %.6f, border %.6f\n", measures->total, border);

  if (fabs(measures->total - 12) > 1e-5 || fabs(border - 24) > 1e-4 || difference > 1e-5) return 1;
  pc_diagram_destroy(diagram);
  pc_domain_destroy(domain);
  pc_device_destroy(device);
  return 0;
}
