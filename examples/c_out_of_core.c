/* Cells of more seeds than memory would hold: seeds come from a function, in blocks, and cells go to a file.
 * Killed and started again, it goes on. Here the seeds are few, and are made up. */
#include <math.h>

#include "c_check.h"

enum { seeds = 20000 };

/* A number in [0, 1) that depends on k alone, as a file would say it. */
static double number(uint64_t k) {
  k = (k + 1) * UINT64_C(0x9e3779b97f4a7c15);
  k = (k ^ (k >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  k = (k ^ (k >> 27)) * UINT64_C(0x94d049bb133111eb);
  return (double)((k ^ (k >> 31)) >> 11) / 9007199254740992.0;
}

static int read_seeds(uint64_t first, size_t count, double* positions, double* weights, void* user) {
  size_t k;
  (void)user;
  for (k = 0; k < 3 * count; ++k) positions[k] = number(3 * first + k);
  for (k = 0; k < count; ++k) weights[k] = 1e-4 * number(3 * (uint64_t)seeds + first + k);
  return 1;
}

static int write_volumes(const pc_cell_rows* rows, void* user) {
  const pc_measures* cells = rows->measures;
  return fwrite(cells->mass, sizeof(double), cells->count, (FILE*)user) == cells->count;
}

int main(void) {
  const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
  pc_device* device = NULL;
  pc_domain* domain = NULL;
  pc_seed_source source;
  pc_out_of_core_options options;
  const pc_out_of_core_report* report = NULL;
  double volume, sum = 0;
  long count = 0;
  int whole;
  FILE* file = tmpfile();
  if (!file) return 1;

  CHECK(pc_device_create(NULL, &device));
  CHECK(pc_domain_box(low, high, 3, &domain));
  CHECK(pc_seed_source_init(&source, sizeof source));
  source.count = seeds;
  source.dimension = 3;
  source.name = "made up seeds, version 1"; /* another name for other seeds */
  source.read = read_seeds;
  CHECK(pc_out_of_core_options_init(&options, sizeof options));
  options.folder = "c_out_of_core.parts"; /* what is finished so far; gone in the end */
  options.memory = UINT64_C(1) << 30;
  options.piece_seeds = 8000; /* to have some pieces of so few seeds */
  CHECK(pc_compute_out_of_core(device, domain, &source, write_volumes, file, &options, &report));

  rewind(file);
  for (; fread(&volume, sizeof volume, 1, file) == 1; ++count) sum += volume;
  printf("%lu cells in %lu pieces, %ld volumes in the file\n", (unsigned long)report->cells,
         (unsigned long)report->pieces, count);
  printf("sum of volumes %.9f\n", sum);
  whole = count == seeds && report->pieces > 1 && fabs(sum - 1) < 1e-9;
  pc_out_of_core_report_destroy(report);
  pc_domain_destroy(domain);
  pc_device_destroy(device);
  fclose(file);
  return whole ? 0 : 1;
}
