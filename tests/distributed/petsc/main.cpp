// doctest on each rank of MPI, with PETSc.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>
#include <petscsys.h>

int main(int argc, char** argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  if (provided < MPI_THREAD_FUNNELED) MPI_Abort(MPI_COMM_WORLD, 1);
  if (PetscInitialize(&argc, &argv, nullptr, nullptr) != 0) MPI_Abort(MPI_COMM_WORLD, 1);
  doctest::Context context(argc, argv);
  const int result = context.run();
  PetscFinalize();
  MPI_Finalize();
  return result;
}
