/// \file
/// What the benchmarks on ranks of MPI have in their main functions.
#pragma once

#include <mpi.h>

#include <cstdio>
#include <exception>

namespace powercell::bench {

/// Calls `run(argc, argv)` between MPI_Init and MPI_Finalize; an exception ends the job.
/// \return the exit code
template <class Run>
int mpi_program(const char* name, int argc, char** argv, const Run& run) {
  try {
    MPI_Init(&argc, &argv);
    const int status = run(argc, argv);
    MPI_Finalize();
    return status;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return MPI_Abort(MPI_COMM_WORLD, 2);
  }
}

}  // namespace powercell::bench
