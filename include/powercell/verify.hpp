/// \file
/// The laws of a power diagram, checked on a computed one (docs/mathematics.md).
#pragma once

#include <cstdint>
#include <powercell/diagram.hpp>
#include <string>
#include <vector>

namespace powercell {

/// One law and how well it was met.
struct LawCheck {
  std::string law;  ///< e.g. "partition: the measures sum to the domain's"
  bool passed = false;
  double value = 0;      ///< the measured defect
  double tolerance = 0;  ///< what was allowed
  std::string detail;    ///< the worst offender, with seed numbers, when not passed
};

struct VerifyOptions {
  std::size_t samples = 1000;  ///< random points whose owner is sought by brute force
  std::uint64_t random_seed = 1;
};

/// Checks the laws that need no reference: partition of the measure, symmetric walls, ownership of
/// random points of the domain by brute force, each cell's pieces against its measure.
/// Tolerances follow from the diagram's precision and size. \throw as Diagram
POWERCELL_API std::vector<LawCheck> verify(Diagram& diagram, const SeedsView& seeds,
                                           const VerifyOptions& options = {});

}  // namespace powercell
