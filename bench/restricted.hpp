/// \file
/// Restricts cells to triangles or tetrahedra: the part of a peer's work that its triangulation does not do.
/// The seeds of a region are found by flooding over the known adjacency, and each (region, seed) piece is
/// clipped by the bisectors with the seed's neighbours. In double; shares no algorithm with lib/.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/base/vectors.hpp"
#include "powercell/seeds.hpp"
#include "tests/support/meshes.hpp"

namespace powercell::bench {

/// The bisector with a neighbour: points y of the cell, relative to its seed, satisfy q . y <= offset.
struct Link {
  Vector3<double> q;
  double offset;
  double distance;  ///< of the bisector from the seed, negative if the seed lies on the neighbour's side
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

/// Areas or volumes of all cells.
/// \param mesh its elements have 3 or 4 `corners`; tetrahedra may have either orientation
std::vector<double> restricted_measures(const test::Mesh& mesh, int corners, const SeedsView& seeds,
                                        const Links& links, unsigned threads);

}  // namespace powercell::bench
