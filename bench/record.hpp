/// \file
/// Results of benchmark runs, and the JSON file that holds them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/contender.hpp"

namespace powercell::bench {

/// The result of one contender at one work. Fields that do not apply are empty.
struct Record {
  std::string part;  ///< part of the report, e.g. "ratios"
  Work work;
  std::string stage, precision, provider;
  bool peer = false;
  std::vector<double> seconds;      ///< wall time of each run
  std::vector<double> cpu_seconds;  ///< user and system time of all threads of each run
  double relative_error = 0;        ///< of the sum of the measures
  double bytes_per_seed = -1;       ///< peak beyond input and output
  std::string skipped;              ///< why it was not run

  Record(std::string part, const Work& work, const Contender& contender);
  double least() const;  ///< of `seconds`; infinity if empty
};

/// Writes the whole file after each record, so that results are not lost if a later run fails.
class RecordFile {
 public:
  /// \throw std::runtime_error if the file cannot be written
  explicit RecordFile(std::string path);
  void add(const Record& record);

 private:
  void write() const;
  std::string path_;
  nlohmann::json all_;
};

}  // namespace powercell::bench
