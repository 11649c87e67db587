/// \file
/// The same work by other libraries: the measure of every power cell in a box or on a mesh. Each is used as
/// its documentation advises, so that a ratio to it is meaningful.
#pragma once

#include <vector>

#include "tests/support/generators.hpp"
#include "tests/support/meshes.hpp"

namespace powercell::bench {

using test::Box;

/// CGAL's regular triangulation, with all points inserted at once. Cells inside the box are measured from the
/// dual, cells that reach its sides by clipping. \return n measures
std::vector<double> cgal_measures_2d(const SeedsView& seeds, const Box& box);
std::vector<double> cgal_measures_3d(const SeedsView& seeds, const Box& box);
/// The same with all loops over dual points and cells by TBB and, in 3D, CGAL's parallel insertion (in 2D
/// CGAL inserts on one thread).
std::vector<double> cgal_parallel_measures_2d(const SeedsView& seeds, const Box& box);
std::vector<double> cgal_parallel_measures_3d(const SeedsView& seeds, const Box& box);

/// The triangulation of the seeds in space, then the cells restricted to the triangles (`corners` 3) or
/// tetrahedra (4) of a mesh (restricted.hpp). "parallel": insertion, adjacency and clipping on all cores.
std::vector<double> cgal_measures_on(const SeedsView& seeds, const test::Mesh& mesh, int corners);
std::vector<double> cgal_parallel_measures_on(const SeedsView& seeds, const test::Mesh& mesh, int corners);

/// Radical cells of voro++ in a box, in its order of blocks. 3D only; all seeds must lie in the box.
std::vector<double> voro_measures(const SeedsView& seeds, const Box& box);
/// The same on all cores. A voro++ container holds the state of the cell being computed, so each thread has a
/// container with all seeds, and takes one row of blocks after the other.
std::vector<double> voro_parallel_measures(const SeedsView& seeds, const Box& box);

}  // namespace powercell::bench
