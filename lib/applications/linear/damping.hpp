/// \file Step control of the damped Newton method for the masses of cells: Kitagawa, Mérigot, Thibert 2019;
/// (27)-(29) of docs/mathematics.md.
#pragma once

#include <algorithm>

namespace powercell {

/// The share of its target below which no cell's mass may fall, (28).
/// \param least  min m_i / v_i at the start
inline double kept_share(double least) {
  return 0.5 * std::min(1.0, least);
}

/// Whether a step of this length decreases the error sufficiently, (29).
inline bool decreases_enough(double after, double before, double length) {
  return after <= (1 - length / 2) * before;
}

/// Backtracking: the first of `longest`, `longest` / 2, `longest` / 4, ... not below `shortest` for which
/// `accepted(length)` holds; 0 if there is none.
template <class Accepted>
double damped_length(double shortest, const Accepted& accepted, double longest = 1) {
  for (double length = longest; length >= shortest; length /= 2)
    if (accepted(length)) return length;
  return 0;
}

}  // namespace powercell
