/// \file
/// Sums and extremes over the seeds of all ranks.
#pragma once

#include "lib/applications/transport/all_seeds.hpp"
#include "lib/base/rank_mailbox.hpp"

namespace powercell {

class RankSeeds : public AllSeeds {
 public:
  /// \param mailbox  kept by reference
  explicit RankSeeds(RankMailbox& mailbox) : mailbox_(mailbox) {}

  std::vector<double> sums(std::vector<double> here) const override {
    return joined(here, [](double a, double b) { return a + b; });
  }
  std::vector<double> greatest(std::vector<double> here) const override {
    return joined(here, [](double a, double b) { return std::max(a, b); });
  }

 private:
  /// Joins in the order of the ranks, so that all get the same bits.
  template <class Join>
  std::vector<double> joined(const std::vector<double>& here, const Join& join) const {
    std::vector<double> result, values;
    for (const Bytes& of_rank : mailbox_.share({packed(here)})) {
      unpack(of_rank, values);
      if (result.empty())
        result = values;
      else
        for (std::size_t k = 0; k < values.size(); ++k) result[k] = join(result[k], values[k]);
    }
    return result;
  }

  RankMailbox& mailbox_;
};

}  // namespace powercell
