/// \file
/// The last step: what is far from the surface comes nearer. Internal.
#pragma once

#include "lib/applications/remeshing/interrupt.hpp"
#include "lib/applications/remeshing/work_mesh.hpp"

namespace powercell::remeshing {

/// Moves vertices of the hundredth of the triangles that is farthest from the surface, and flips their edges,
/// where that brings what is around them nearer and makes no shape worse than it was or than an angle of 40
/// degrees and a quality of .74. Topology and curves stay.
void fit(WorkMesh& mesh, const Surface& surface, const Sizing& sizing, int passes, Progress progress = {});

}  // namespace powercell::remeshing
