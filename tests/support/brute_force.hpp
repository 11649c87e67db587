/// \file
/// The power diagram by definition: every region of the domain is cut by the bisectors of every seed with
/// every other, in long double. There is no search, no early exit and no code shared with lib/.
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

/// The correct diagram of n seeds, by input index.
struct ReferenceDiagram {
  std::vector<Real> mass;           ///< n
  std::vector<Vec> first;           ///< n: integral of x - p_i over the cell (not yet divided by mass)
  std::vector<Real> second_moment;  ///< n: integral of |x - p_i|^2
  std::vector<Real> surface;        ///< n: measure of the boundary of all pieces, for error bounds
  std::vector<SeedStatus> status;   ///< n; hidden if no piece has a positive measure
  /// Directed walls: {i, j} from the pieces of i, {j, i} from those of j.
  std::map<std::pair<std::uint32_t, std::uint32_t>, Real> wall;
  /// The change of each wall if all planes move by 1, for error bounds: twice the length of its rim (both
  /// planes that meet there move) over the sine of their angle.
  std::map<std::pair<std::uint32_t, std::uint32_t>, Real> rim;
  /// The seeds, ascending, of each point of the domain where exactly d+1 cells meet; on polygons and surfaces
  /// the last entry is repeated. Reliable in general position only.
  std::set<std::array<std::uint32_t, 4>> simplices;

  Real total() const;
};

ReferenceDiagram brute_force(const RegionMesh& mesh, const SeedsView& seeds);

/// As brute_force, but cuts seed i by the seeds candidates[offset[i] .. offset[i+1]) only: makes cells of the
/// domain from an adjacency known from elsewhere (CGAL). `skip` must mark seeds without candidates, except an
/// only seed.
ReferenceDiagram cut_by_candidates(const RegionMesh& mesh, const SeedsView& seeds,
                                   std::span<const std::uint64_t> offset,
                                   std::span<const std::uint32_t> candidates,
                                   std::span<const std::uint8_t> skip);

/// A region relative to `origin`, with the borders of its facets.
Polygon region_polygon(const RegionMesh& mesh, std::size_t region, const Vec& origin = {});
Polyhedron region_polyhedron(const RegionMesh& mesh, std::size_t region, const Vec& origin = {});

/// The half-space of points y = x - p_i nearer, in power distance, to seed i than to seed j.
HalfSpace bisector(const SeedsView& seeds, std::size_t i, std::size_t j);

/// pow_i(x) = |x - p_i|^2 - w_i.
Real power(const SeedsView& seeds, std::size_t i, std::span<const double> x);
/// The owner of x among all seeds, and the difference of its power distance to the next one.
std::pair<std::size_t, Real> owner(const SeedsView& seeds, std::span<const double> x);

/// A box as a domain of one region, made without the library.
RegionMesh box_mesh(int dimension, const Box& box = {});

}  // namespace powercell::test
