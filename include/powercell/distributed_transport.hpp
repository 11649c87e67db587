/// \file
/// Semi-discrete optimal transport whose seeds are on several ranks, none of which has all of them.
#pragma once

#include <cstdint>
#include <powercell/communicator.hpp>
#include <powercell/transport.hpp>
#include <span>
#include <vector>

namespace powercell {

/// The rows that one rank has of a symmetric, positive semidefinite matrix, with as many columns as rows.
struct DistributedRows {
  std::uint64_t first = 0;  ///< number of the first row here; the rows of rank 0 come first, then those of 1
  std::uint64_t total = 0;  ///< rows of all ranks
  std::span<const std::uint64_t> offset;  ///< n + 1: the entries of row i here are [offset[i], offset[i+1])
  std::span<const std::uint64_t> column;  ///< ascending within a row, with the diagonal
  std::span<const double> value;          ///< 0 or less off the diagonal, which is at least their sum
  /// The rows sum to 0, and only constants solve L x = 0.
  bool singular = false;
};

/// What a DistributedLinearSolver finds.
struct DistributedSolution {
  std::vector<double> values;  ///< of the rows here; in a singular system up to a constant
  int iterations = 0;          ///< the same on all ranks; 0 for a direct solver
};

/// Solves linear systems whose rows are on the ranks of a transport, which calls it in the thread of its
/// caller. With PETSc: PetscSolver of powercell/petsc.hpp.
class POWERCELL_API DistributedLinearSolver {
 public:
  DistributedLinearSolver() = default;
  DistributedLinearSolver(const DistributedLinearSolver&) = delete;
  DistributedLinearSolver& operator=(const DistributedLinearSolver&) = delete;
  virtual ~DistributedLinearSolver();

  /// Solves L x = b. All ranks call it at the same time, those without rows too. It must throw on all ranks
  /// or on none, as those that go on would wait for ever. Without a solution it returns the best values that
  /// it has, or NaN.
  /// \param right  b of the rows here; sums to 0 over all ranks if the system is singular
  /// \param tolerance  of |b - L x| / |b|
  virtual DistributedSolution solve(const DistributedRows& rows, std::span<const double> right,
                                    double tolerance) = 0;
};

struct DistributedTransportOptions {
  /// As for one process, and the same on all ranks but for `progress` and `diagram`. The density must be
  /// constant, `periodic` false and `linear` automatic. Where `progress` returns false, the solve ends on all
  /// ranks. In the steps that it gets, all is of all ranks but times; `linear` is automatic throughout.
  TransportOptions transport;
  /// As DistributedOptions::redistribute, for each diagram.
  bool redistribute = false;
};

/// Finds the weights for seeds and masses of all ranks, by the damped Newton method of TransportSolver, with
/// the cells of compute_distributed. All ranks must call it, each with its own seeds, with the same domain
/// and options; ranks without seeds too. Weights are those of one process up to the tolerance. An error on
/// one rank is thrown on all, as by compute_distributed. In messages, seeds are numbered through the ranks:
/// those of rank 0 come first, in their order.
///
/// To solve again for seeds that moved, from p to p', give them the weights w - |p' - p|² of the last result.
/// \param solver  over the same ranks; used within the call
/// \param seeds   of this rank, of the domain's dimension also where there are none; the solve starts from
///                their weights, or from 0 without
/// \param masses  as many; or none on all ranks, for equal masses
/// \return arrays of the seeds of this rank, numbers of all, the same on all ranks. Of seeds at one position
///         the first by number has the cell and the mass of all of them, and all have its weight;
///         `merged_with` is empty
/// \throw Error invalid_argument (sizes, masses, no seeds on any rank, options out of range or that differ
///        between ranks, and in what), invalid_seed, unsupported (densities that are not constant, periodic
///        domains and what compute_distributed refuses), interrupted, and as Diagram
POWERCELL_API TransportResult transport_distributed(Communicator& communicator,
                                                    DistributedLinearSolver& solver, const Device& device,
                                                    const Domain& domain, const SeedsView& seeds,
                                                    std::span<const double> masses = {},
                                                    const DistributedTransportOptions& options = {});

}  // namespace powercell
