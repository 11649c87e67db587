/// \file
/// Improvement of the new mesh: number of vertices, shapes of triangles, distance from the surface.
#pragma once

#include "lib/applications/remeshing/progress.hpp"
#include "lib/applications/remeshing/work_mesh.hpp"

namespace powercell::remeshing {

/// Flips edges if that makes degrees more regular without angles below about 30 degrees, or increases the
/// least angle of the two triangles.
/// \return the number of flips
/// \throw Error interrupted, as the functions below
std::size_t flip_edges(WorkMesh& mesh, const Surface& surface, Progress progress = {});

/// Brings the mesh to `count` vertices by collapsing its relatively shortest edges or splitting its longest.
/// Corners stay, and curves keep their ends.
/// \return false if neither topology nor shape allow that few
/// \throw Error invalid_argument (no edge is left to split)
bool reach_count(WorkMesh& mesh, const Surface& surface, const Sizing& sizing, std::size_t count,
                 Progress progress = {});

/// Relaxation: `rounds` of flips and moves, at first to the centroids of the adjacent triangles weighted by
/// h^-4, then to improve shapes; then flips and moves at the worst triangles only, as long as they improve.
/// Topology and curves stay.
void relax(WorkMesh& mesh, const Surface& surface, const Sizing& sizing, int rounds, Progress progress = {});

/// Moves vertices of the 1 % of the triangles farthest from the surface, and flips their edges, if that
/// brings the triangles around closer to it. No shape becomes worse than it was, or than an angle of 40
/// degrees and a quality of 0.74. Topology and curves stay.
/// \param passes  at most; fewer if nothing changes
void fit(WorkMesh& mesh, const Surface& surface, const Sizing& sizing, int passes, Progress progress = {});

}  // namespace powercell::remeshing
