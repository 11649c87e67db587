/* A Voronoi treemap of a small tree in a regular octagon. */
#include <math.h>

#include "c_check.h"

static double area_of(const pc_treemap* map, size_t node) {
  const uint64_t first = map->vertex_offset[node], last = map->vertex_offset[node + 1];
  double area = 0;
  uint64_t k;
  for (k = first; k < last; ++k) {
    const double* a = map->vertices + 2 * k;
    const double* b = map->vertices + 2 * (k + 1 < last ? k + 1 : first);
    area += (a[0] * b[1] - a[1] * b[0]) / 2;
  }
  return area;
}

int main(void) {
  enum { n = 7, corners = 8 };
  static const char* const names[n] = {"energy", "sun", "wind", "roofs", "fields", "sea", "land"};
  const int64_t parent[n] = {PC_NO_PARENT, 0, 0, 1, 1, 2, 2};
  const double value[n] = {0, 0, 0, 30, 20, 40, 10};
  double outline[2 * corners], whole;
  pc_treemap_options options;
  const pc_treemap* map = NULL;
  size_t i;

  CHECK(pc_shape_disk(corners, outline));
  CHECK(pc_treemap_options_init(&options, sizeof options));
  options.names = names; /* for messages */
  CHECK(pc_treemap_create(parent, value, n, outline, corners, &options, &map));

  whole = area_of(map, 0);
  for (i = 0; i < n; ++i) {
    const double share = area_of(map, i) / whole;
    printf("%*s%s: %.4f %%\n", 2 * (int)map->depth[i], "", names[i], 100 * share);
    if (fabs(share - map->value[i] / 100) > 1e-5) return 1;
  }
  printf("%lu leaves, all within %.0e: %s\n", (unsigned long)map->leaves, options.tolerance,
         map->not_converged_count == 0 ? "yes" : "no");

  if (map->leaves != 4 || map->worst_error > options.tolerance) return 1;
  pc_treemap_destroy(map);
  return 0;
}
