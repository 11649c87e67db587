/// \file
/// What a benchmark run measured, and the JSON file it ends up in.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/contender.hpp"

namespace powercell::bench {

/// One contender at one work. Fields that do not apply stay empty.
struct Record {
  std::string part;  ///< which question the run answers; free, the report goes by it
  Work work;
  std::string stage, precision, provider;
  bool peer = false;
  std::vector<double> seconds;      ///< wall time of each run
  std::vector<double> cpu_seconds;  ///< user and system time of all threads of each run
  double relative_error = 0;        ///< of the sum of the measures
  double bytes_per_seed = -1;       ///< peak beyond input and output
  std::string skipped;              ///< why it was not run

  Record(std::string part, const Work& work, const Contender& contender);
  double least() const;  ///< of `seconds`; infinity where there are none
};

/// Keeps the file whole after each record, so that what is measured is not lost.
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
