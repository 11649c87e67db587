/* A new mesh of a torus with 300 vertices: its quality beside that of the old one. */
#include <math.h>

#include "c_check.h"

static void print(const char* name, const pc_mesh_quality* quality) {
  printf("%s: %lu vertices, least angle %.1f, mean quality %.3f, Euler characteristic %d\n", name,
         (unsigned long)quality->vertices, quality->angle_min, quality->q_mean,
         quality->euler_characteristic);
}

int main(void) {
  const pc_triangle_mesh* torus = NULL;
  const pc_repaired_mesh* repaired = NULL;
  const pc_remesh_result* mesh = NULL;
  const pc_mesh_quality *before = NULL, *after = NULL;
  pc_remesh_options options;
  double distance = 0;
  int fails;

  CHECK(pc_shape_torus(16, &torus));
  /* pc_remesh() repairs its input by itself; this shows what it would find. */
  CHECK(pc_repair(torus->vertices, torus->vertex_count, torus->triangles, torus->triangle_count, -1,
                  &repaired));
  printf("repair: %s\n", repaired->report->changed ? repaired->report->acts[0] : "nothing to do");

  CHECK(pc_remesh_options_init(&options, sizeof options));
  options.count = 300;
  options.contrast = 1; /* edges of one length */
  CHECK(pc_remesh(torus->vertices, torus->vertex_count, torus->triangles, torus->triangle_count, &options,
                  &mesh));
  CHECK(pc_mesh_quality_create(torus->vertices, torus->vertex_count, torus->triangles, torus->triangle_count,
                               &before));
  CHECK(pc_mesh_quality_create(mesh->vertices, mesh->vertex_count, mesh->triangles, mesh->triangle_count,
                               &after));
  print("before", before);
  print("after", after);
  CHECK(pc_farthest_from(mesh->vertices, mesh->vertex_count, mesh->triangles, mesh->triangle_count,
                         torus->vertices, torus->vertex_count, torus->triangles, torus->triangle_count, 0,
                         &distance));
  printf("farthest from the old surface: less than 0.1: %s\n", distance < 0.1 ? "yes" : "no");

  fails = after->vertices != 300 || after->euler_characteristic != 0 || !after->manifold ||
          after->angle_min < 25 || distance >= 0.1 || repaired->report->changed;
  pc_mesh_quality_destroy(before);
  pc_mesh_quality_destroy(after);
  pc_remesh_result_destroy(mesh);
  pc_repaired_mesh_destroy(repaired);
  pc_triangle_mesh_destroy(torus);
  return fails;
}
