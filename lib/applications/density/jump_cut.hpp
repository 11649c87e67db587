/// \file
/// Integration over a simplex that a jump of the density crosses.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lib/applications/density/simplex_rule.hpp"

namespace powercell {

/// Quadrature points with their contributions to the integral of the density over a simplex scaled to measure
/// 1.
struct JumpCut {
  struct Term {
    Barycentric point;
    double mass = 0;
    double lower = 0;  ///< contribution by the next lower rule, see SimplexRules
  };
  std::vector<Term> terms;
  double error = 0;  ///< error of the mass from the position of the jump, in addition to that of the rules
};

/// Evaluates the density at points of the simplex.
using ValuesAt = std::function<void(std::span<const Barycentric>, std::span<double>)>;

/// Finds where the edges of a simplex cross a jump and how the jump bends between them, and applies rules on
/// both sides of it. The method is our own: docs/mathematics.md, (32b).
/// \param dimension  of the simplex: 1, 2 or 3
/// \param corner     the density at its corners
/// \param allowed    desired error of the mass; smaller jumps are ignored
/// \param most       limit on the error of the mass
/// \param cut        the result, overwritten in any case
/// \return false unless each edge has at most one jump, the jumps divide the corners into two sides, and the
///   error is at most `most`
bool cut_at_jump(int dimension, std::span<const double> corner, const ValuesAt& values, double allowed,
                 double most, JumpCut& cut);

}  // namespace powercell
