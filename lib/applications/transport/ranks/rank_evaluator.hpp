/// \file
/// Evaluation of weights whose seeds are on several ranks.
#pragma once

#include <powercell/distributed.hpp>
#include <powercell/distributed_transport.hpp>

#include "lib/applications/transport/evaluator.hpp"
#include "lib/applications/transport/ranks/beyond.hpp"

namespace powercell {

/// What the ranks of a transport have in common.
struct OnRanks {
  Communicator& communicator;
  DistributedLinearSolver& solver;
  RankMailbox& mailbox;
  const AllSeeds& all;
  const Numbering& numbers;
};

class RankEvaluator : public Evaluator {
 public:
  /// All are kept by reference but the domain.
  /// \param density    mass per unit of measure
  /// \param kept       indices of the seeds here that are not merged
  /// \param positions  of these
  RankEvaluator(const OnRanks& ranks, const Device& device, const Domain& domain, double density,
                const std::vector<std::uint32_t>& kept, std::span<const double> positions,
                const DistributedTransportOptions& options);

  bool connects_all(const Laplacian& system) override;
  LinearResult solve(const Laplacian& system, const Vector& right) override;

 private:
  void measure(Iterate& at) override;
  DistributedCells cells_of(const Vector& weights) const;
  /// The solution as the solver finds it. All ranks call it.
  DistributedSolution solution(const Laplacian& system, const Vector& right);

  OnRanks ranks_;
  const Device& device_;
  double density_;
  const DistributedTransportOptions& options_;
  std::vector<std::uint64_t> ids_;  // of the seeds that are not merged: their numbers
  Beyond beyond_;
};

}  // namespace powercell
