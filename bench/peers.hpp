/// \file
/// Other libraries doing the same work: the measure of every power cell in a box or on a mesh. Each is used
/// as its own documentation advises, so that a ratio to it means something.
#pragma once

#include <vector>

#include "tests/support/generators.hpp"
#include "tests/support/meshes.hpp"

namespace powercell::bench {

using test::Box;

/// CGAL's regular triangulation, points inserted in bulk; cells inside the box are measured from the
/// dual, those that meet its sides by clipping. \return n measures
std::vector<double> cgal_measures_2d(const SeedsView& seeds, const Box& box);
std::vector<double> cgal_measures_3d(const SeedsView& seeds, const Box& box);
/// The same with all loops over dual points and cells in TBB, and in space with CGAL's parallel insertion (in
/// the plane CGAL inserts on one thread).
std::vector<double> cgal_parallel_measures_2d(const SeedsView& seeds, const Box& box);
std::vector<double> cgal_parallel_measures_3d(const SeedsView& seeds, const Box& box);

/// The same triangulation of the seeds in space, then the cells restricted to the triangles (`corners` 3) or
/// tetrahedra (4) of a mesh (restricted.hpp); "parallel": insertion, adjacency and clipping on all cores.
std::vector<double> cgal_measures_on(const SeedsView& seeds, const test::Mesh& mesh, int corners);
std::vector<double> cgal_parallel_measures_on(const SeedsView& seeds, const test::Mesh& mesh, int corners);

/// voro++ radical cells in a box (space only, all seeds in the box), computed in its own block order.
std::vector<double> voro_measures(const SeedsView& seeds, const Box& box);
/// The same on all cores. A voro++ container keeps the state of the cell it works on, so each thread has a
/// container of its own with all seeds in it, and takes the next row of blocks when it is done with one.
std::vector<double> voro_parallel_measures(const SeedsView& seeds, const Box& box);

}  // namespace powercell::bench
