/// \file
/// Two records of the benchmark beside each other.
#pragma once

#include <string>
#include <vector>

#include "apps/bench/saved_record.hpp"

namespace powercell::app {

/// A rate over another.
struct Ratio {
  double value = 0;
  double scatter = 0;  ///< of the runs of both together, as shares

  /// Whether the rates may be equal: they differ by less than their runs scatter.
  bool tells_nothing() const;
};

/// Rates of a row over those of another.
struct BenchRatio {
  const SavedRow *now, *then;  ///< of the records that were compared
  Ratio measures, adjacency;
  const Ratio& least() const { return measures.value < adjacency.value ? measures : adjacency; }
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

/// "other programs kept 1.3 of its processors busy", if that is over a twentieth of them; else empty.
std::string busy_text(unsigned processors, double others);

/// The devices of one record: tables of the rates of each over those of the first; nothing if there is one.
std::string comparison_of_devices(const SavedRecord& record);

}  // namespace powercell::app
