/// \file
/// Comparisons of a diagram to a reference, which return lists of differences in words.
#pragma once

#include <powercell/diagram.hpp>
#include <string>
#include <vector>

#include "tests/support/brute_force.hpp"

namespace powercell::test {

using Differences = std::vector<std::string>;

/// The allowed differences from the reference, by seed, derived from the precision and the input only.
///
/// A computation with unit roundoff u is exact for bisectors moved by
///     shift = c u (reach + |q| + |w_i - w_j| / |q|)
/// where `reach` is the largest distance of the domain from the seed. Moving the planes of a cell by `shift`
/// changes its measure by at most shift times its surface. Returned coordinates are doubles in either
/// precision; far from 0 their rounding counts too.
class Tolerances {
 public:
  Tolerances(double roundoff, const RegionMesh& mesh, const SeedsView& seeds,
             const ReferenceDiagram& reference);

  double reach(std::size_t i) const { return reach_[i]; }
  double mass(std::size_t i) const { return mass_[i]; }
  /// For a wall between i and j, whose rim moves by `shift` over the sine of the angle of the planes there.
  /// For a wall that the reference does not have, the measure that a sliver of that thickness may have.
  /// Infinite for walls of a cell so thin that moving its planes may make it vanish.
  double wall(std::size_t i, std::size_t j) const;
  double coordinate() const { return coordinate_; }
  /// For a measure computed from returned coordinates.
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

/// Compares masses, centroids, second moments and statuses.
Differences compare_measures(const Measures& measures, const ReferenceDiagram& reference,
                             const SeedsView& seeds, const Tolerances& tolerances);

/// Compares walls and their measures. Walls below the tolerance may exist or not; `optional`, if given, is
/// set to the number of walls that only one of the two has for that reason.
Differences compare_walls(const Adjacency& adjacency, const ReferenceDiagram& reference,
                          const Tolerances& tolerances, std::size_t* optional = nullptr);

/// Checks that rows ascend, no seed is its own neighbour, and j is in row i exactly if i is in row j, with
/// the same measure.
Differences check_symmetric(const Adjacency& adjacency);

/// Compares the sets of simplices, and checks their orientation. For seeds in general position.
/// \param uncertain  number of simplices that only one side may have, since float may join or separate close
///                   corners
Differences compare_dual(const Dual& dual, const ReferenceDiagram& reference, const SeedsView& seeds,
                         DomainKind kind, std::size_t uncertain);

/// The first few differences, as text.
std::string summary(const Differences& differences);

}  // namespace powercell::test
