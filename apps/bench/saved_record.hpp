/// \file
/// Records of benchmarks in files.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "apps/bench/record.hpp"

namespace powercell::app {

inline constexpr const char* bench_format = "powercell bench";
inline constexpr int bench_format_version = 1;

/// What a comparison needs of a row.
struct SavedRow {
  std::string device, selector, domain, precision;
  std::size_t n = 0;
  double rate = 0, adjacency_rate = 0;        ///< cells a second
  double scatter = 0, adjacency_scatter = 0;  ///< of the runs; 0 in records that were saved before it was

  std::string title() const;  ///< for messages: "cube in double with 1,000 seeds on NAME"
};

struct SavedRecord {
  std::string path, version, revision, date, description;
  std::vector<SavedRow> rows;  ///< those that did not fail
  unsigned processors = 0;     ///< of the host; here and below 0 if it is not known
  double others = 0;           ///< of them, as many as other programs used meanwhile

  /// The row of this device, domain, precision and number of seeds (0 for any), or null. Of several devices
  /// with the same name the one with the same selector is preferred.
  const SavedRow* find(const std::string& device, const std::string& selector, const std::string& domain,
                       const std::string& precision, std::size_t n) const;

  /// The numbers of seeds, ascending, of the rows of this device, domain and precision.
  std::vector<std::size_t> sizes(const std::string& device, const std::string& selector,
                                 const std::string& domain, const std::string& precision) const;

  /// The same with the rows of one device alone.
  SavedRecord of_device(const std::string& selector) const;
};

/// What a file of the record would hold.
/// \param path  a name for messages
SavedRecord saved(const BenchRecord& record, const std::string& path);

/// Reads a file written from `as_json`.
/// \throw Error invalid_file
SavedRecord read_record(const std::string& path);
/// The same from memory.
/// \param name  for messages
SavedRecord parse_record(std::string_view bytes, const std::string& name);

}  // namespace powercell::app
