/// \file
/// Integration over a simplex that a jump of the density goes through. Internal.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lib/applications/density/simplex_rule.hpp"

namespace powercell {

/// Points and what each has of the mass, the density being integrated over a simplex of measure 1.
struct JumpCut {
  struct Term {
    Barycentric point;
    double mass = 0;
    double lower = 0;  ///< by the rule before, as SimplexRules are nested
  };
  std::vector<Term> terms;
  double error = 0;  ///< of the mass, for where the jump is taken to lie; that of the rules comes on top
};

/// The density at points of the simplex.
using ValuesAt = std::function<void(std::span<const Barycentric>, std::span<double>)>;

/// Finds where the edges of a simplex cross a jump, and how far that bends between them, and applies rules on
/// both sides of it. The method is ours: docs/mathematics.md, (32b).
/// \param dimension  of the simplex: 1, 2 or 3
/// \param corner     the density at its corners
/// \param allowed    how much the mass should be off at most: jumps of less are none
/// \param most       how much it may be off
/// \param cut        what was found, in any case overwritten
/// \return false unless each edge has one jump or none, they divide the corners in two, and the error is not
///   above `most`
bool cut_at_jump(int dimension, std::span<const double> corner, const ValuesAt& values, double allowed,
                 double most, JumpCut& cut);

}  // namespace powercell
