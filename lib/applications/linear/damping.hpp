/// \file
/// The step control of the damped Newton method for masses of cells: Kitagawa, Merigot, Thibert 2019,
/// mathematics (27)-(29). Internal.
#pragma once

#include <algorithm>

namespace powercell {

/// What every cell keeps, in parts of its target, by (28). \param least  min m_i / v_i at the start
inline double kept_share(double least) {
  return 0.5 * std::min(1.0, least);
}

/// Whether a step of this length makes an error fall as (29) asks.
inline bool falls_enough(double reached, double before, double length) {
  return reached <= (1 - length / 2) * before;
}

/// The first of the lengths `longest`, half of it, a quarter, ... down to `shortest` that `accepted(length)`
/// takes; 0 if none.
template <class Accepted>
double damped_length(double shortest, const Accepted& accepted, double longest = 1) {
  for (double length = longest; length >= shortest; length /= 2)
    if (accepted(length)) return length;
  return 0;
}

}  // namespace powercell
