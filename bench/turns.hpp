/// \file
/// Runs contenders in turns, so that what else the machine does falls on all of them.
#pragma once

#include <string>
#include <vector>

#include "bench/record.hpp"

namespace powercell::bench {

struct TurnOptions {
  std::string part = "ratios";
  std::vector<std::string> ours;  ///< "stage:provider", of this library
  bool peers = true;
  std::vector<std::string> only_peers;       ///< of the peers, where not empty
  Precision precision = Precision::float64;  ///< of this library
  double seconds = 6;                        ///< for one work: rounds end when they took longer
  int rounds = 5;                            ///< at most
  int least_rounds = 1;                      ///< however long they take
  /// A peer, or the FLANN provider, that took this many times as long as the fastest peer at fewer seeds is
  /// left out; 0: nobody is. Below 10^5 seeds, where what is done once weighs more, twice as many times
  /// count; below 10^4 none do. Where the first n is large, a tenth of it is tried before.
  double drop = 0;
};

/// The same kind of work for ascending n; \param work its n is ignored
void run_series(Work work, std::vector<std::size_t> n, const TurnOptions& options, RecordFile& file);

/// All contenders that `options` names, in the order they are run. \throw std::invalid_argument
std::vector<std::unique_ptr<Contender>> contenders(const Work& work, const Domain& domain,
                                                   const SeedArray& seeds, const TurnOptions& options);

}  // namespace powercell::bench
