#include "lib/update/repair.hpp"

#include <algorithm>
#include <utility>

#include "lib/update/flips.hpp"
#include "lib/update/refill.hpp"

namespace powercell {
namespace {

bool same_place(const Site& a, const Site& b) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/// Seeds at one place are duplicates, which the mesh does not know. Two that have cells make flat simplices,
/// and insert() finds one that has; this finds those among the hidden. \throw MeshUnusable
template <int D>
void refuse_duplicates(const DualMesh<D>& mesh, std::vector<std::uint32_t> hidden) {
  const auto place = [&](std::uint32_t site) {
    const Site& s = mesh.sites()[site];
    return std::array<double, 3>{s[0] + 0.0, s[1] + 0.0, s[2] + 0.0};
  };
  std::sort(hidden.begin(), hidden.end(),
            [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
  const auto twice = std::adjacent_find(hidden.begin(), hidden.end(), [&](std::uint32_t a, std::uint32_t b) {
    return same_place(mesh.sites()[a], mesh.sites()[b]);
  });
  if (twice != hidden.end()) throw MeshUnusable();
}

/// \return the number of sites inserted
template <int D>
std::size_t insert_hidden(DualMesh<D>& mesh, bool moved, std::vector<std::uint32_t>& added) {
  std::size_t inserted = 0;
  std::vector<std::uint32_t> hidden = mesh.take_hidden();
  std::sort(hidden.begin(), hidden.end());
  for (const std::uint32_t site : hidden) {
    const std::uint32_t near = mesh.near_hidden(site);
    if (mesh.insert(site, near, &added))
      ++inserted;
    else
      mesh.hide(site, near);
  }
  if (moved) {
    // Those hidden before or after: one of two may have been inserted once the other was found hidden.
    hidden.insert(hidden.end(), mesh.hidden().begin(), mesh.hidden().end());
    std::sort(hidden.begin(), hidden.end());
    hidden.erase(std::unique(hidden.begin(), hidden.end()), hidden.end());
    refuse_duplicates(mesh, std::move(hidden));
  }
  return inserted;
}

}  // namespace

template <int D>
RepairCounts repair(DualMesh<D>& mesh, const Broken& broken, bool moved, std::vector<Center>& centers) {
  RepairCounts counts;
  Flipper<D> flipper(mesh);
  for (const std::uint32_t s : broken.inverted) flipper.add_inverted(s);
  for (const std::uint32_t f : broken.facets) flipper.add_facet(f);
  for (;;) {
    flipper.run();
    std::vector<std::uint32_t> stuck = flipper.take_stuck_sites();
    if (stuck.empty()) break;
    counts.refilled += refill_around(mesh, flipper, std::move(stuck));
    if (counts.refilled > mesh.site_count()) throw MeshUnusable();
  }
  counts.flips = flipper.flips();
  std::vector<std::uint32_t>& added = flipper.added();
  counts.inserted = insert_hidden(mesh, moved, added);
  centers.resize(mesh.simplex_count());
  for (const std::uint32_t s : added)
    if (!mesh.is_removed(s)) centers[s] = center_of(mesh, s);
  return counts;
}

template RepairCounts repair(DualMesh<2>&, const Broken&, bool, std::vector<Center>&);
template RepairCounts repair(DualMesh<3>&, const Broken&, bool, std::vector<Center>&);

}  // namespace powercell
