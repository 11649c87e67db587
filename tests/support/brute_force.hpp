/// \file
/// The power diagram by definition: every region of the domain is cut by the bisectors of every seed
/// with every other, in long double. No search, no early stop, no code shared with lib/.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "lib/domain/region_mesh.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/polytope.hpp"

namespace powercell::test {

/// What a correct diagram is. n seeds, by input index.
struct ReferenceDiagram {
  std::vector<Real> mass;           ///< n
  std::vector<Vec> first;           ///< n: integral of x - p_i over the cell (not yet divided by mass)
  std::vector<Real> second_moment;  ///< n: integral of |x - p_i|^2
  std::vector<Real> surface;        ///< n: measure of the boundary of all pieces, for error bounds
  std::vector<SeedStatus> status;   ///< n; hidden means no piece has a measure above zero
  /// Directed walls: {i, j} from the pieces of i, {j, i} from those of j.
  std::map<std::pair<std::uint32_t, std::uint32_t>, Real> wall;
  /// By how much each wall changes when all planes are moved by one: the length of its rim over the sine
  /// of the angle between the planes that meet there (twice that, as both move). For error bounds.
  std::map<std::pair<std::uint32_t, std::uint32_t>, Real> rim;
  /// Corners, ascending, of each point of the domain where exactly d+1 cells meet (third or fourth
  /// seed absent on polygons and surfaces: the last entry is then repeated). Only sure in general position.
  std::set<std::array<std::uint32_t, 4>> simplices;

  Real total() const;
};

ReferenceDiagram brute_force(const RegionMesh& mesh, const SeedsView& seeds);

/// As brute_force, but seed i is cut by the seeds candidates[offset[i] .. offset[i+1]) only; turns an
/// adjacency known from elsewhere (CGAL) into cells of the domain. Seeds without candidates that are
/// not the only seed must be marked hidden by `skip`.
ReferenceDiagram cut_by_candidates(const RegionMesh& mesh, const SeedsView& seeds,
                                   std::span<const std::uint64_t> offset,
                                   std::span<const std::uint32_t> candidates,
                                   std::span<const std::uint8_t> skip);

/// The half-space of points y = x - p_i nearer (in power) to seed i than to seed j.
HalfSpace bisector(const SeedsView& seeds, std::size_t i, std::size_t j);

/// pow_i(x) = |x - p_i|^2 - w_i.
Real power(const SeedsView& seeds, std::size_t i, std::span<const double> x);
/// The seed of least power at x, by looking at all of them; with the gap to the next one.
std::pair<std::size_t, Real> owner(const SeedsView& seeds, std::span<const double> x);

/// A box as a domain of one region, made here and not by the library.
RegionMesh box_mesh(int dimension, const Box& box = {});

}  // namespace powercell::test
