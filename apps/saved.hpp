/// \file
/// A diagram read back from the JSON that `diagram -o FILE.json` writes, and the laws on it. Nothing of
/// the library computes here: measures and walls are derived again from the vertices in the file.
#pragma once

#include <cstdint>
#include <optional>
#include <powercell/powercell.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace powercell::app {

/// A face of a saved cell. Polygons and surfaces: `border` has one entry an edge, the edge that starts at
/// the vertex of the same place; volumes: one entry.
struct SavedFace {
  std::vector<std::uint32_t> loop;                  ///< places in the cell's vertices
  std::vector<std::optional<std::int64_t>> border;  ///< a seed; -1-facet of the boundary; none: goes on
};

struct SavedCell {
  std::vector<double> position, vertices;  ///< d; d a vertex
  std::vector<double> centroid;            ///< d, or none
  double weight = 0, measure = 0;
  SeedStatus status = SeedStatus::ok;
  std::vector<SavedFace> faces;
};

/// What the head of a file says of its cells.
struct SavedSummary {
  std::size_t cells = 0, hidden = 0, duplicate = 0;
  double measure = 0, domain_measure = 0;
};

struct SavedDiagram {
  DomainKind kind = DomainKind::polygon;
  int dimension = 2;
  double domain_measure = 0;
  std::optional<SavedSummary> summary;
  std::vector<SavedCell> cells;  ///< in the order of the seeds
};

/// \throw Error invalid_file (what, and which cell)
SavedDiagram read_saved(const std::string& path);
/// The same from memory. \param name  for messages
SavedDiagram parse_saved(std::string_view bytes, const std::string& name);

/// The laws that a file can show: partition; the summary, where there is one, is that of the cells; each
/// cell's measure from its own vertices, and its centroid where there is one; walls the same from both sides;
/// every vertex on the bisectors it borders; no seed nearer to a vertex than its cell's. \param samples
/// vertices that are held against all seeds
std::vector<LawCheck> check_saved(const SavedDiagram& diagram, Precision precision,
                                  const VerifyOptions& options);

}  // namespace powercell::app
