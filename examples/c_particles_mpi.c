/* Particles of a simulation that are on the ranks of MPI: each has those that began in its slab of a cube. In
 * each step every rank gets the cells of its particles among those of all ranks, and moves its particles
 * towards the centroids of their cells. What is printed does not depend on the number of ranks.
 *
 *   mpirun -n 4 c_particles_mpi [PARTICLES [STEPS]] */
#include <math.h>
#include <powercell_mpi.h>
#include <stdlib.h>

#include "c_check.h"

/* The particles of this rank. */
typedef struct particles {
  size_t count;
  uint64_t* id;
  double *position, *weight; /* 3 and 1 for each */
} particles;

/* A number in [0, 1) that depends on k alone. */
static double number(uint64_t k) {
  k = (k + 1) * UINT64_C(0x9e3779b97f4a7c15);
  k = (k ^ (k >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  k = (k ^ (k >> 27)) * UINT64_C(0x94d049bb133111eb);
  return (double)((k ^ (k >> 31)) >> 11) / 9007199254740992.0;
}

/* Of the same particles on any number of ranks, those that begin in the slab of this rank. */
static int start(particles* own, uint64_t all, const pc_communicator* ranks) {
  const double radius = 0.5 * cbrt(1.0 / (double)all);
  uint64_t id;
  int k;
  own->count = 0;
  own->id = malloc(all * sizeof(uint64_t));
  own->position = malloc(3 * all * sizeof(double));
  own->weight = malloc(all * sizeof(double));
  if (!own->id || !own->position || !own->weight) return 0;
  for (id = 0; id < all; ++id) {
    if ((int)(number(4 * id) * ranks->size) != ranks->rank) continue;
    for (k = 0; k < 3; ++k) own->position[3 * own->count + (size_t)k] = number(4 * id + (uint64_t)k);
    own->weight[own->count] = pow(radius * number(4 * id + 3), 2);
    own->id[own->count++] = id;
  }
  return 1;
}

/* Moves particles halfway to the centroids of their cells. */
static void relax(particles* own, const pc_measures* cells) {
  size_t i, k;
  for (i = 0; i < own->count; ++i)
    for (k = 3 * i; cells->status[i] == PC_SEED_OK && k < 3 * i + 3; ++k)
      own->position[k] += 0.5 * (cells->centroid[k] - own->position[k]);
}

/* One step. Prints it on the first rank and sets *energy, which the moves make smaller. */
static int step(int at, particles* own, const pc_communicator* ranks, const pc_device* device,
                const pc_domain* domain, int* is_whole, double* energy) {
  const pc_distributed_cells* cells = NULL;
  double sums[4] = {0, 0, 0, 0}; /* particles, volume, energy, walls */
  size_t i;
  CHECK(pc_compute_distributed(ranks, device, domain, own->id, own->position, own->weight, own->count, NULL,
                               &cells));
  sums[0] = (double)own->count;
  sums[1] = cells->measures->total;
  for (i = 0; i < own->count; ++i)
    sums[2] += cells->measures->second_moment[i] - own->weight[i] * cells->measures->mass[i];
  sums[3] = (double)cells->entry_count;
  relax(own, cells->measures);
  pc_distributed_cells_destroy(cells);
  MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  if (ranks->rank == 0)
    printf("step %d: %.0f particles, volume %.12f, energy %.8f, %.3f walls a cell\n", at, sums[0], sums[1],
           sums[2], sums[3] / sums[0]);
  *is_whole = *is_whole && fabs(sums[1] - 1) < 1e-12 && sums[2] < *energy;
  *energy = sums[2];
  return 0;
}

/* 0 if each step had all of the cube's volume and less energy than the one before. */
static int simulate(uint64_t count, int steps) {
  const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
  pc_communicator ranks;
  pc_device* device = NULL;
  pc_domain* domain = NULL;
  particles own;
  double energy = HUGE_VAL;
  int is_whole = 1, at;
  CHECK(pc_device_create(NULL, &device));
  CHECK(pc_domain_box(low, high, 3, &domain));
  CHECK(pc_mpi_communicator_create(MPI_COMM_WORLD, 0, &ranks));
  if (!start(&own, count, &ranks)) return 1;
  for (at = 0; at < steps; ++at)
    if (step(at, &own, &ranks, device, domain, &is_whole, &energy)) return 1; /* on all ranks alike */
  free(own.weight);
  free(own.position);
  free(own.id);
  pc_mpi_communicator_destroy(&ranks);
  pc_domain_destroy(domain);
  pc_device_destroy(device);
  return is_whole ? 0 : 1;
}

int main(int argc, char** argv) {
  int provided = 0, status;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  status = simulate(argc > 1 ? strtoull(argv[1], NULL, 10) : 1000, argc > 2 ? atoi(argv[2]) : 5);
  if (status) MPI_Abort(MPI_COMM_WORLD, status); /* a rank that failed alone must not leave others waiting */
  MPI_Finalize();
  return 0;
}
