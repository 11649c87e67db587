/// \file
/// The laws of a power diagram, checked on a computed one (docs/mathematics.md).
#pragma once

#include <cstdint>
#include <functional>
#include <powercell/diagram.hpp>
#include <string>
#include <vector>

namespace powercell {

/// One law and how well it holds.
struct LawCheck {
  std::string law;  ///< e.g. "partition: the measures sum to the domain's"
  bool passed = false;
  double value = 0;      ///< the measured defect
  double tolerance = 0;  ///< the largest defect allowed
  std::string detail;    ///< if not passed: the worst offender, with seed numbers
};

struct VerifyOptions {
  std::size_t samples = 1000;  ///< random points at which all seeds are tried
  std::uint64_t random_seed = 1;
  /// Called after each law of a Diagram with the fraction done; returning false stops with Error interrupted.
  std::function<bool(double)> progress = {};
};

/// A diagram without its domain, as `powercell diagram -o FILE.json` saves it. Nothing is owned.
struct SavedDiagram {
  DomainKind kind = DomainKind::polygon;
  Precision precision = Precision::float64;  ///< in which it was computed: float32 or float64
  SeedsView seeds;                           ///< n
  const Measures& measures;                  ///< n; `centroid` may be empty, `second_moment` is not read
  const JoinedCells& cells;                  ///< n
};

/// Checks the laws that need no reference: partition of the measure; statuses; walls equal from both sides
/// and on their bisectors; each cell's measure and centroid from its pieces; random points of the domain in
/// the cell of least power distance, found by trying all seeds; in a solid vertices of the cells in place of
/// these points. Tolerances follow from the diagram's precision and size.
/// \throw Error unsupported if seeds are selected; as Diagram
POWERCELL_API std::vector<LawCheck> verify(Diagram& diagram, const SeedsView& seeds,
                                           const VerifyOptions& options = {});

/// The same laws from the arrays alone, nothing of which is trusted; vertices of the cells take the place of
/// random points.
/// \throw Error invalid_argument if the arrays do not fit together (which cell); unsupported for cells of a
/// periodic domain, which have shifts
POWERCELL_API std::vector<LawCheck> verify(const SavedDiagram& diagram, const VerifyOptions& options = {});

}  // namespace powercell
