/// \file
/// A computed diagram against a reference: lists of differences in words, empty when they agree.
#pragma once

#include <powercell/diagram.hpp>
#include <string>
#include <vector>

#include "tests/support/brute_force.hpp"

namespace powercell::test {

using Differences = std::vector<std::string>;

/// How far a result may be from the reference, seed by seed, from the precision and the input alone.
///
/// A computation in floating point with unit roundoff u is the exact one for bisectors moved by
/// `shift` = c u (reach + |q| + |w_i - w_j| / |q|), where `reach` is how far the domain extends from the
/// seed. Moving the planes of a cell by `shift` changes its measure by at most shift times its surface.
/// Coordinates given back are doubles whatever the kernels compute in; far from 0 their rounding counts too.
class Tolerances {
 public:
  Tolerances(double roundoff, const RegionMesh& mesh, const SeedsView& seeds,
             const ReferenceDiagram& reference);

  double reach(std::size_t i) const { return reach_[i]; }
  double mass(std::size_t i) const { return mass_[i]; }
  /// Of a wall between i and j: its rim moves by `shift` over the sine of the angle of the planes there.
  /// Of a wall that the reference does not have: what a sliver of that thickness may show. Unbounded for
  /// walls of a cell so thin that moving its planes may make it vanish.
  double wall(std::size_t i, std::size_t j) const;
  double coordinate() const { return coordinate_; }
  /// Of a measure worked out from coordinates that were given back.
  double mass_from_geometry(std::size_t i) const { return mass_[i] * (1 + coordinate_ / shift_[i]); }
  double wall_from_geometry(std::size_t i, std::size_t j) const {
    return wall(i, j) * (1 + coordinate_ / std::min(shift_[i], shift_[j]));
  }

 private:
  std::vector<double> shift_, reach_, mass_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> rim_;  // i < j
  double extent_ = 0;  // spacing of the seeds to the power of the dimension of a wall's rim
  double coordinate_ = 0;
  std::vector<bool> may_vanish_;
};

/// Masses, centroids, second moments and statuses.
Differences compare_measures(const Measures& measures, const ReferenceDiagram& reference,
                             const SeedsView& seeds, const Tolerances& tolerances);

/// Wall sets and wall measures. Walls below the tolerance may be there or not; `optional`, if given,
/// receives how many such walls only one side has.
Differences compare_walls(const Adjacency& adjacency, const ReferenceDiagram& reference,
                          const Tolerances& tolerances, std::size_t* optional = nullptr);

/// Rows ascending, no seed its own neighbour, j in row i exactly when i is in row j with the same measure.
Differences check_symmetric(const Adjacency& adjacency);

/// Simplices as sets against the reference, and their orientation. Meant for seeds in general position;
/// `doubtful` allows that many corners on either side only (float may join or part near corners).
Differences compare_dual(const Dual& dual, const ReferenceDiagram& reference, const SeedsView& seeds,
                         DomainKind kind, std::size_t doubtful);

/// Prints at most the first few.
std::string summary(const Differences& differences);

}  // namespace powercell::test
