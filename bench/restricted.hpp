/// \file
/// The part of a peer's work that a triangulation does not do by itself: cells restricted to the triangles of
/// a surface or to tetrahedra. Each region's seeds are found by flooding over the known adjacency, and each
/// (region, seed) piece is clipped by the bisectors with the seed's neighbours. In double, nothing shared
/// with lib/.
#pragma once

#include <cstdint>
#include <vector>

#include "powercell/seeds.hpp"
#include "tests/support/meshes.hpp"

namespace powercell::bench {

/// The bisector with a neighbour: the cell's points y (relative to its seed) have q . y <= offset.
struct Link {
  double q[3];
  double offset;
  double distance;  ///< of the bisector from the seed, negative when the seed lies outside its cell
  std::uint32_t neighbor;
};

/// Row i holds the bisectors that bound the cell of seed i in space, nearest first; hidden seeds have none.
struct Links {
  std::vector<std::size_t> offset;  ///< n + 1
  std::vector<Link> list;

  const Link* begin(std::size_t i) const { return list.data() + offset[i]; }
  const Link* end(std::size_t i) const { return list.data() + offset[i + 1]; }
};

/// The bisector between seeds i and j, seen from i.
Link make_link(const SeedsView& seeds, std::uint32_t i, std::uint32_t j);

/// Areas or volumes of all cells. \param mesh its elements have 3 or 4 corners, as `corners` says; tetrahedra
/// in either orientation   \param threads shares of the regions are taken by so many
std::vector<double> restricted_measures(const test::Mesh& mesh, int corners, const SeedsView& seeds,
                                        const Links& links, unsigned threads);

}  // namespace powercell::bench
