/// \file
/// Results as a markdown table: a row for each stage, domain, distribution, weights and n; the ways of
/// computing it beside each other, with ratios to the first peer that ran.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace powercell::bench {

/// Passes runs on to the console reporter (on stderr) and prints the table when all are done.
class TableReporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;
  bool failed() const { return failed_; }

 private:
  struct Entry {
    std::string way;  ///< "double tree", "CGAL", …
    double seconds;
    double cells_per_second;
  };
  std::vector<std::pair<std::string, std::vector<Entry>>> rows_;  ///< in order of running
  bool failed_ = false;
};

}  // namespace powercell::bench
