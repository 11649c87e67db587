/// \file
/// Diagrams read back from the JSON that `diagram -o FILE.json` writes.
#pragma once

#include <optional>
#include <powercell/powercell.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace powercell::app {

/// The counts and sums at the head of a file.
struct SavedSummary {
  std::size_t cells = 0, hidden = 0, duplicate = 0;
  double measure = 0, domain_measure = 0;
};

struct SavedFile {
  DomainKind kind = DomainKind::polygon;
  std::vector<double> positions, weights;
  Measures measures;  ///< without second moments; without centroids where no cell has one
  JoinedCells cells;
  std::optional<SavedSummary> summary;
};

/// \throw Error invalid_file (the fault, and which cell)
SavedFile read_saved(const std::string& path);
/// The same from memory.
/// \param name  for messages
SavedFile parse_saved(std::string_view bytes, const std::string& name);

/// The library's laws on the cells and, if there is a summary, whether it agrees with them.
std::vector<LawCheck> check_saved(const SavedFile& file, Precision precision, const VerifyOptions& options);

}  // namespace powercell::app
