/// \file
/// Two records of the benchmark beside each other.
#pragma once

#include <string>
#include <vector>

#include "apps/bench/saved_record.hpp"

namespace powercell::app {

/// Rates of a row over those of another.
struct BenchRatio {
  const SavedRow *now, *then;  ///< of the records that were compared
  double measures = 0, adjacency = 0;
  /// Of the runs of both.
  double scatter() const { return now->scatter > then->scatter ? now->scatter : then->scatter; }
  double least() const { return measures < adjacency ? measures : adjacency; }
};

/// For each row the one of the same device, domain, precision and number of seeds in the earlier record, if
/// there is one.
std::vector<BenchRatio> same_rows(const SavedRecord& now, const SavedRecord& then);

/// For two records that were made apart: the same, and where there is no such row, one of another number of
/// seeds. If the records have no device in common, rows of every other device.
std::vector<BenchRatio> alike_rows(const SavedRecord& now, const SavedRecord& then);

/// A table of the ratios, and the number of rows of `now` without a counterpart.
std::string comparison(const SavedRecord& now, const SavedRecord& then,
                       const std::vector<BenchRatio>& ratios);

}  // namespace powercell::app
