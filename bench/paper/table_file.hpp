/// \file
/// Writes the data of a figure: a CSV file whose first lines, after '#', say what it was made on.
#pragma once

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <powercell/device.hpp>
#include <string>
#include <variant>
#include <vector>

namespace powercell::paper {

/// What the figures have in common.
struct Study {
  Device device;
  std::filesystem::path folder;  ///< where files go
  bool quick = false;            ///< small inputs, to see that everything works
};

/// A command line: [--quick] [--out FOLDER] and the other words.
struct Command {
  Study study;
  std::vector<std::string> words;
};
/// \throw Error invalid_argument (an unknown option), and those of Device::choose
Command parse_command(int argc, char** argv);

class TableFile {
 public:
  using Value = std::variant<std::string, double, std::uint64_t>;
  /// Writes FOLDER/NAME.csv. \param setting what the figure varies and what it keeps, one line
  TableFile(const Study& study, const std::string& name, const std::string& setting,
            std::initializer_list<const char*> columns);
  /// One value a column; numbers with four digits. \throw Error write_failed when it cannot be written
  void row(std::initializer_list<Value> values);

 private:
  std::filesystem::path path_;
  std::ofstream file_;
  std::size_t columns_;
};

}  // namespace powercell::paper
