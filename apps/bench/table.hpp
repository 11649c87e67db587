/// \file
/// The benchmark as text, alone and compared to an earlier one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/bench/record.hpp"

namespace powercell::app {

std::string table_head();
std::string table_line(const BenchRow& row);

/// Rates of a row over the earlier rates.
struct BenchRatio {
  const BenchRow* row;  ///< the caller's
  double measures = 0, adjacency = 0;
  double least() const { return measures < adjacency ? measures : adjacency; }
};

/// The rows that did not fail and have an earlier one of the same device, domain, precision and n.
std::vector<BenchRatio> compare(const BenchRecord& record, const EarlierRecord& earlier);

/// A table of the ratios, and the number of rows without a counterpart.
std::string comparison(const BenchRecord& record, const EarlierRecord& earlier,
                       const std::vector<BenchRatio>& ratios);

}  // namespace powercell::app
