/// \file
/// CGAL on triangle meshes, behind a plain header: checks of a mesh, and isotropic remeshing as a peer.
#pragma once

#include <powercell/shapes.hpp>

namespace powercell::bench {

/// CGAL's checks of a mesh made from an input.
struct MeshVerdict {
  bool valid = false;  ///< a polygon mesh in CGAL's sense: an oriented manifold
  bool self_intersecting = false;
  int euler = 0;  ///< vertices - edges + faces
  int boundary_loops = 0;
  double mesh_to_input = 0, input_to_mesh = 0;  ///< one-sided Hausdorff distances, by 200,000 random points
};

MeshVerdict check_by_cgal(const TriangleMesh& input, const TriangleMesh& mesh);

/// CGAL's isotropic remeshing with `iterations`, protecting the edges that PMP::detect_sharp_edges finds.
/// Searches the edge length until the mesh has `count` vertices within 1 %, in at most seven attempts, since
/// on regular inputs the number jumps. \param seconds  output: processor time of the last attempt
TriangleMesh remesh_by_cgal(const TriangleMesh& input, std::size_t count, int iterations, double sharp_angle,
                            double& seconds);

}  // namespace powercell::bench
