/// \file
/// The last relaxation: vertices slide on the surface, edges flip, until triangles are well shaped.
#pragma once

#include "lib/applications/remeshing/progress.hpp"
#include "lib/applications/remeshing/work_mesh.hpp"

namespace powercell::remeshing {

/// Flips what makes degrees regular without angles below some 30 degrees, and what makes the least angle of
/// two triangles larger. Returns how many.
std::size_t flip_edges(WorkMesh& mesh, const Surface& surface, Progress progress = {});

/// Brings the mesh to `count` vertices by collapses of its relatively shortest edges or splits of its
/// longest. Curves are left as they are. \throw Error invalid_argument where the topology forbids it;
/// interrupted, as the others
void reach_count(WorkMesh& mesh, const Surface& surface, const Sizing& sizing, std::size_t count,
                 Progress progress = {});

/// `rounds` of flips and of moves to the centroids of the triangles around, weighted by h^-4; then moves
/// and flips of the worst shaped triangles alone, as long as they get better. Topology and curves stay.
void relax(WorkMesh& mesh, const Surface& surface, const Sizing& sizing, int rounds, Progress progress = {});

/// Moves vertices of the 1 % of the triangles farthest from the surface, and flips their edges, if that
/// brings the triangles around closer to it. No shape becomes worse than it was, or than an angle of 40
/// degrees and a quality of 0.74. Topology and curves stay. \param passes  at most; fewer if nothing changes
void fit(WorkMesh& mesh, const Surface& surface, const Sizing& sizing, int passes, Progress progress = {});

}  // namespace powercell::remeshing
