/// \file
/// Tables of cells and walls that are written as cells come.
#pragma once

#include <cstdint>
#include <memory>
#include <powercell/out_of_core.hpp>
#include <string>
#include <vector>

#include "apps/io/tables/seed_stream.hpp"
#include "apps/io/write/cell_writers.hpp"
#include "apps/report.hpp"

namespace powercell::app {

/// The files of --table and --walls, either of which may be empty.
/// \param shift_axes  of the domain (inputs.hpp); with 3 all that there may be
std::vector<std::string> cell_file_names(const std::string& table, const std::string& walls, int shift_axes);

/// Writes the files as cells come, and gives them their names with the last ones.
class CellFiles {
 public:
  /// \param seeds  read again for a table that repeats them
  /// \param report  receives the sum of the measures; both are kept by reference
  CellFiles(std::string table, std::string walls, io::SeedStream& seeds, const Domain& domain,
            RunReport& report);

  /// Ascending, each seed once. With the last ones checks the sum of the measures.
  /// \throw Error internal (the sum), write_failed, invalid_file (the seeds were changed meanwhile)
  void take(const CellRows& rows);
  /// If there are no seeds.
  void take_none(double domain_measure);

 private:
  void begin(std::uint64_t walls);
  void end(double domain_measure);

  std::string table_, walls_;
  io::SeedStream& seeds_;
  int dimension_, shift_axes_;
  RunReport& report_;
  std::vector<double> positions_, weights_;  // of some seeds
  std::vector<std::unique_ptr<io::CellWriter>> writers_;
};

}  // namespace powercell::app
