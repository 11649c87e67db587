/// \file
/// Runs contenders in turns, so that other load of the machine affects all of them.
#pragma once

#include <string>
#include <vector>

#include "bench/record.hpp"

namespace powercell::bench {

struct TurnOptions {
  std::string part = "ratios";
  std::vector<std::string> ours;  ///< "stage:provider", of this library
  bool peers = true;
  std::vector<std::string> only_peers;       ///< restricts the peers if not empty
  Precision precision = Precision::float64;  ///< of this library
  double seconds = 6;                        ///< time limit for the rounds of one work
  int rounds = 5;                            ///< the most
  int least_rounds = 1;                      ///< the fewest, however long they take
  /// Leaves out a peer, or the FLANN provider, that took this many times as long as the fastest peer at fewer
  /// seeds; 0 leaves out none. Results below 10^5 seeds, where constant costs weigh more, must exceed twice
  /// this factor; those below 10^4 are ignored. If the smallest n is large, a tenth of it is tried first.
  double drop = 0;
};

/// Runs the same kind of work for ascending n. \param work its n is ignored
void run_series(Work work, std::vector<std::size_t> n, const TurnOptions& options, RecordFile& file);

/// All contenders that `options` selects, in the order in which they run. \throw std::invalid_argument
std::vector<std::unique_ptr<Contender>> contenders(const Work& work, const Domain& domain,
                                                   const SeedArray& seeds, const TurnOptions& options);

}  // namespace powercell::bench
