/// \file
/// A DistributedLinearSolver with PETSc. In this header alone: the libraries of powercell know of neither
/// PETSc nor MPI. CMake: find_package(powercell COMPONENTS petsc) has powercell::petsc.
#pragma once

// First, because it has MPI without the remains of the C++ bindings, which PETSc would include too.
#include <petscksp.h>

#include <powercell/mpi.hpp>

#ifndef PETSC_HAVE_HYPRE
#error "powercell/petsc.hpp needs a PETSc that was built with hypre, as Debian's is"
#endif

#include <algorithm>
#include <cstdint>
#include <limits>
#include <powercell/distributed_transport.hpp>
#include <powercell/error.hpp>
#include <string>
#include <vector>

namespace powercell {

/// Conjugate gradients, preconditioned by the algebraic multigrid BoomerAMG of hypre. Options of PETSc with
/// the prefix `powercell_`, such as -powercell_ksp_monitor, overrule that; not all preconditioners can do
/// with ranks without rows (GAMG of PETSc 3.18 does not end). An error of PETSc ends the job, as others would
/// wait for ever.
class PetscSolver : public DistributedLinearSolver {
 public:
  /// Duplicates the communicator: all its ranks must make theirs at the same time.
  /// \param communicator  the ranks of the transport, in the same order
  /// \throw Error invalid_argument (PETSc is not running)
  explicit PetscSolver(MPI_Comm communicator = PETSC_COMM_WORLD) {
    PetscBool is_running = PETSC_FALSE, is_over = PETSC_FALSE;
    PetscInitialized(&is_running);
    PetscFinalized(&is_over);
    if (is_running == PETSC_FALSE || is_over == PETSC_TRUE)
      throw Error(ErrorCode::invalid_argument,
                  "a PetscSolver is made between PetscInitialize and PetscFinalize");
    static_assert(sizeof(PetscScalar) == sizeof(double),
                  "powercell needs a PETSc of real numbers in double precision");
    MPI_Comm_dup(communicator, &own_);
    // By default BoomerAMG factorises the coarsest matrix, which is singular here.
    prefer("-powercell_pc_hypre_boomeramg_relax_type_coarse", "symmetric-SOR/Jacobi");
    // Levels of few entries, as for all matrices in space: with the defaults a system takes four times as
    // long.
    prefer("-powercell_pc_hypre_boomeramg_coarsen_type", "PMIS");
    prefer("-powercell_pc_hypre_boomeramg_interp_type", "ext+i");
    prefer("-powercell_pc_hypre_boomeramg_P_max", "4");
    prefer("-powercell_pc_hypre_boomeramg_agg_nl", "1");
  }
  /// After PetscFinalize there is nothing left to free.
  ~PetscSolver() override {
    PetscBool is_over = PETSC_FALSE;
    PetscFinalized(&is_over);
    if (is_over == PETSC_TRUE) return;
    MPI_Comm_free(&own_);
  }

  DistributedSolution solve(const DistributedRows& rows, std::span<const double> right,
                            double tolerance) override {
    require_indices(rows);
    return solve_or_end(rows, right, tolerance);
  }

 private:
  static constexpr PetscInt most_iterations = 500;  // 10 to 20 are usual

  /// An exception on one rank, as of memory that runs out, would leave others waiting; here it ends the job.
  DistributedSolution solve_or_end(const DistributedRows& rows, std::span<const double> right,
                                   double tolerance) noexcept {
    Mat matrix = matrix_of(rows);
    Vec b = nullptr, x = nullptr;
    const auto local = static_cast<PetscInt>(right.size());
    PetscCallAbort(own_, VecCreateMPIWithArray(own_, 1, local, PETSC_DECIDE, right.data(), &b));
    PetscCallAbort(own_, VecDuplicate(b, &x));
    KSP solver = solver_of(matrix, tolerance);
    PetscCallAbort(own_, KSPSolve(solver, b, x));

    DistributedSolution found;
    PetscInt iterations = 0;
    PetscCallAbort(own_, KSPGetIterationNumber(solver, &iterations));
    found.iterations = static_cast<int>(iterations);
    const double* values = nullptr;
    PetscCallAbort(own_, VecGetArrayRead(x, &values));
    found.values.assign(values, values + local);
    PetscCallAbort(own_, VecRestoreArrayRead(x, &values));
    PetscCallAbort(own_, KSPDestroy(&solver));
    PetscCallAbort(own_, VecDestroy(&x));
    PetscCallAbort(own_, VecDestroy(&b));
    PetscCallAbort(own_, MatDestroy(&matrix));
    return found;
  }

  /// Sets an option that the user has not set.
  void prefer(const char* name, const char* value) {
    PetscBool is_set = PETSC_FALSE;
    PetscCallAbort(own_, PetscOptionsHasName(nullptr, nullptr, name, &is_set));
    if (is_set == PETSC_FALSE) PetscCallAbort(own_, PetscOptionsSetValue(nullptr, name, value));
  }

  void require_indices(const DistributedRows& rows) const {
    // Rows of all and entries of each rank are numbered by PetscInt, of 32 bits in most packages.
    std::uint64_t most = std::max<std::uint64_t>(rows.total, rows.column.size());
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_UINT64_T, MPI_MAX, own_);
    if (most > static_cast<std::uint64_t>(std::numeric_limits<PetscInt>::max()))
      throw Error(ErrorCode::unsupported, "a linear system of " + std::to_string(rows.total) +
                                              " rows on all ranks, or of too many entries on one, needs a "
                                              "PETSc with indices of 64 bits");
  }

  Mat matrix_of(const DistributedRows& rows) const {
    const std::vector<PetscInt> offset(rows.offset.begin(), rows.offset.end()),
        column(rows.column.begin(), rows.column.end());
    const auto local = static_cast<PetscInt>(offset.size() - 1), all = static_cast<PetscInt>(rows.total);
    Mat matrix = nullptr;
    PetscCallAbort(own_, MatCreateMPIAIJWithArrays(own_, local, local, all, all, offset.data(), column.data(),
                                                   rows.value.data(), &matrix));
    PetscCallAbort(own_, MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
    if (rows.singular) {
      MatNullSpace constants = nullptr;
      PetscCallAbort(own_, MatNullSpaceCreate(own_, PETSC_TRUE, 0, nullptr, &constants));
      PetscCallAbort(own_, MatSetNullSpace(matrix, constants));
      PetscCallAbort(own_, MatNullSpaceDestroy(&constants));
    }
    return matrix;
  }

  KSP solver_of(Mat matrix, double tolerance) const {
    KSP solver = nullptr;
    PetscCallAbort(own_, KSPCreate(own_, &solver));
    PetscCallAbort(own_, KSPSetOptionsPrefix(solver, "powercell_"));
    PetscCallAbort(own_, KSPSetType(solver, KSPCG));
    PetscCallAbort(own_, KSPSetNormType(solver, KSP_NORM_UNPRECONDITIONED));
    PC preconditioner = nullptr;
    PetscCallAbort(own_, KSPGetPC(solver, &preconditioner));
    PetscCallAbort(own_, PCSetType(preconditioner, PCHYPRE));
    PetscCallAbort(own_, PCHYPRESetType(preconditioner, "boomeramg"));
    PetscCallAbort(own_, KSPSetOperators(solver, matrix, matrix));
    PetscCallAbort(own_, KSPSetTolerances(solver, tolerance, 0, PETSC_DEFAULT, most_iterations));
    PetscCallAbort(own_, KSPSetFromOptions(solver));
    return solver;
  }

  MPI_Comm own_ = MPI_COMM_NULL;
};

}  // namespace powercell
